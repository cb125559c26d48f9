/* Exit status and message of a program that MPI ends while it starts. The interface is in mpi_start.f90. */
#define _DEFAULT_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { FEW_FILES = 64, NOT_WRITTEN = 3, NO_RESOURCES = 4 };   /* Open MPI 4.1 starts with 32 files */

static int is_starting;

/* Exit status of a program that ends while MPI starts: MPI has one of its own, which has another meaning here. */
static int status_of_start(int status)
{
   struct rlimit files;
   char text[200] = "ehlwave-sweep: MPI could not be started, see above\n";
   if (!is_starting) return status;
   is_starting = 0;
   if (getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur < FEW_FILES)
      snprintf(text, sizeof text, "ehlwave-sweep: MPI could not be started: only %d files may be open (ulimit -n), allow %d\n",
               (int)files.rlim_cur, FEW_FILES);
   return write(STDERR_FILENO, text, strlen(text)) < 0 ? NOT_WRITTEN : NO_RESOURCES;
}

#ifdef SYS_exit_group
/* Stands before the function of the C library, which Open MPI ends the program by when it cannot start. */
void _exit(int status)
{
   status = status_of_start(status);
   for (;;) syscall(SYS_exit_group, status);
}
#endif

static void end_for_start(void)
{
   if (is_starting) _exit(status_of_start(1));
}

/* Between two calls, with 1 and with 0, MPI starts: where it ends the program, a line is printed, with status 4. */
void ehlwave_watch_start(int begins)
{
   if (begins) atexit(end_for_start);
   is_starting = begins;
}
