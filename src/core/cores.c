/* The cores that this process may use, and how its threads wait. The interfaces are in threads.f90. */
#define _GNU_SOURCE
#include <limits.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Which cores this process may run on: is_mine[i] is 1, else 0. Returns their number; 0 where the system does not tell. */
int ehlwave_cores(int *is_mine, int size)
{
   int count = 0;
   memset(is_mine, 0, (size_t)size*sizeof *is_mine);
#ifdef __linux__
   cpu_set_t set;
   if (sched_getaffinity(0, sizeof set, &set) != 0) return 0;
   for (int i = 0; i < size && i < CPU_SETSIZE; i++)
      if (CPU_ISSET(i, &set)) count += is_mine[i] = 1;
#endif
   return count;
}

/* The cores' worth of time that a container may have, rounded up; INT_MAX: no limit. */
int ehlwave_core_quota(void)
{
   long quota, period;
   int cores = INT_MAX;
   FILE *file = fopen("/sys/fs/cgroup/cpu.max", "r");
   if (!file) return cores;
   if (fscanf(file, "%ld %ld", &quota, &period) == 2 && quota > 0 && period > 0) cores = (int)((quota + period - 1)/period);
   fclose(file);
   return cores;
}

/* Let threads that wait for others leave the processor soon: on a busy machine those that they wait for need it. The runtime of
   OpenMP (GNU's) reads how long they spin when a program is loaded, so the program starts itself anew, once. Where that is not
   possible it goes on as it is. */
void ehlwave_wait_briefly(void)
{
   static const char name[] = "GOMP_SPINCOUNT";
   char path[4096], *arguments[1024];
   static char line[262144];
   if (getenv(name) || getenv("OMP_WAIT_POLICY")) return;
   ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
   FILE *file = fopen("/proc/self/cmdline", "r");
   if (!file) return;
   size_t size = fread(line, 1, sizeof line, file), count = 0;
   fclose(file);
   if (length <= 0 || size == 0 || size == sizeof line || line[size - 1]) return;
   path[length] = 0;
   for (char *next = line; next < line + size; next += strlen(next) + 1) {
      if (count + 1 == sizeof arguments/sizeof arguments[0]) return;
      arguments[count++] = next;
   }
   arguments[count] = NULL;
   if (setenv(name, "2000", 1) != 0) return;
   execv(path, arguments);
   unsetenv(name);
}
