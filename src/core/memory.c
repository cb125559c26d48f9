/* How much memory this process can have, and its end where the system gives no more. The interfaces are in memory.f90.

   Programs are linked with --wrap=malloc, calloc and realloc where the linker knows it (src/CMakeLists.txt): whatever our own files
   allocate, temporary arrays of the compiler included, passes through here, so that no place has to look at the answer. So does the
   start of OpenMP's threads, where it is GNU's (--wrap=GOMP_parallel). */
#define _GNU_SOURCE
#include <errno.h>
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#ifdef __linux__
#define PROGRAM program_invocation_short_name
#else
#define PROGRAM "ehlwave"
#endif

enum { OUT_OF_MEMORY = 4 };   /* exit status */

enum { STACK_BYTES = 524288 };   /* the deepest calls of a case and the message of its end take less */

/* Have the stack before the program begins: where a limit on addresses is reached, a stack that has to grow ends the program by
   SIGSEGV, the message below included. */
__attribute__((constructor, noinline)) static void have_stack(void)
{
   volatile char stack[STACK_BYTES];
   for (size_t i = sizeof stack; i > 0; i -= 4096) stack[i - 1] = 0;
}

/* End the program with one line for want of memory. */
__attribute__((noreturn)) void ehlwave_out_of_memory(size_t bytes)
{
   static int is_ending = 0;
   char text[300];
   if (is_ending) _exit(OUT_OF_MEMORY);   /* what is done at exit wants memory, too */
   is_ending = 1;
   int length = snprintf(text, sizeof text, "%s: out of memory: the system does not give %.3g MiB more. Take fewer cells "
                         "(--plan says what they need), or give the program more memory\n",
                         PROGRAM, (double)bytes/1048576);
   if (write(STDERR_FILENO, text, (size_t)length) < 0) _exit(OUT_OF_MEMORY);
   exit(OUT_OF_MEMORY);
}

#ifdef EHLWAVE_WRAPS_ALLOCATION
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);

static void *answer(void *memory, size_t size)
{
   if (!memory && size > 0) ehlwave_out_of_memory(size);
   return memory;
}

void *__wrap_malloc(size_t size) { return answer(__real_malloc(size), size); }

void *__wrap_calloc(size_t count, size_t size) { return answer(__real_calloc(count, size), count*size); }

void *__wrap_realloc(void *old, size_t size) { return answer(__real_realloc(old, size), size); }
#else
#define __real_malloc malloc
#endif

/* Whether so much memory could be allocated now. */
int ehlwave_can_allocate(size_t bytes)
{
   void *volatile memory = __real_malloc(bytes);   /* volatile: else the compiler leaves both calls out */
   int is_there = memory != NULL;
   free(memory);
   return is_there;
}

#ifdef EHLWAVE_WRAPS_TEAMS
enum { TEAM_BYTES = 65536 };   /* more than libgomp takes for a team: 1.5 KiB and about 100 bytes a thread */

void __real_GOMP_parallel(void (*body)(void *), void *data, unsigned threads, unsigned flags);

int omp_get_max_threads(void);
int omp_get_num_threads(void);

/* A single thread needs no team. libgomp allocates one by itself, and would end the program with a status of its own. */
void __wrap_GOMP_parallel(void (*body)(void *), void *data, unsigned threads, unsigned flags)
{
   if (threads <= 1 && omp_get_max_threads() == 1 && omp_get_num_threads() == 1) {
      body(data);
      return;
   }
   if (!ehlwave_can_allocate(TEAM_BYTES)) ehlwave_out_of_memory(TEAM_BYTES);
   __real_GOMP_parallel(body, data, threads, flags);
}
#endif

/* Give pages of freed memory back to the system, where malloc does not by itself: holes between arrays in use. */
void ehlwave_return_memory(void)
{
#ifdef __GLIBC__
   malloc_trim(0);
#endif
}

static double smaller(double a, double b) { return a < b ? a : b; }

/* The number that a file begins with; DBL_MAX if there is none, as where a limit is "max". */
static double number_in(const char *path)
{
   double value = DBL_MAX;
   FILE *file = fopen(path, "r");
   if (!file) return DBL_MAX;
   if (fscanf(file, "%lf", &value) != 1) value = DBL_MAX;
   fclose(file);
   return value;
}

/* The smallest limit of a control group and of those it belongs to. In a container the system may show the group as the root. */
static double limit_of_group(const char *root, const char *group, const char *name)
{
   char path[4096], place[4096];
   double limit = DBL_MAX;
   snprintf(place, sizeof place, "%s", group);
   for (;;) {
      if (snprintf(path, sizeof path, "%s%s/%s", root, place, name) < (int)sizeof path) limit = smaller(limit, number_in(path));
      char *slash = strrchr(place, '/');
      if (!slash) return limit;
      *slash = 0;
   }
}

/* What the control groups of this process allow, version 2 and 1. */
static double limit_of_groups(void)
{
   char line[4096];
   double limit = DBL_MAX;
   FILE *file = fopen("/proc/self/cgroup", "r");
   if (!file) return DBL_MAX;
   while (fgets(line, sizeof line, file)) {
      line[strcspn(line, "\n")] = 0;
      char *memory = strstr(line, ":memory:");
      if (strncmp(line, "0::", 3) == 0) limit = smaller(limit, limit_of_group("/sys/fs/cgroup", line + 3, "memory.max"));
      if (memory) limit = smaller(limit, limit_of_group("/sys/fs/cgroup/memory", memory + 8, "memory.limit_in_bytes"));
   }
   fclose(file);
   return limit;
}

/* Memory of the machine and its swap space. */
static double memory_of_machine(void)
{
   char line[200];
   double kib, total = 0;
   FILE *file = fopen("/proc/meminfo", "r");
   if (!file) return DBL_MAX;
   while (fgets(line, sizeof line, file))
      if (sscanf(line, "MemTotal: %lf", &kib) == 1 || sscanf(line, "SwapTotal: %lf", &kib) == 1) total += 1024*kib;
   fclose(file);
   return total > 0 ? total : DBL_MAX;
}

/* Bytes that this process can have in memory at most. A limit on addresses counts also what is mapped and never touched, as
   most of a library: so much less is left. */
double ehlwave_memory_limit(void)
{
   static double fixed = 0;               /* the part that is read once: the files of the system take as long as a small plan */
   struct rlimit addresses;
   if (fixed == 0) fixed = smaller(memory_of_machine(), limit_of_groups());
   double mapped = 0, resident = 0, limit = fixed;
   FILE *file = fopen("/proc/self/statm", "r");
   if (file) {
      if (fscanf(file, "%lf %lf", &mapped, &resident) != 2) mapped = resident = 0;
      fclose(file);
   }
   if (getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY)
      limit = smaller(limit, (double)addresses.rlim_cur - (mapped - resident)*(double)sysconf(_SC_PAGESIZE));
   return limit;
}
