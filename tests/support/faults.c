/* A library to preload: one call of the system on the files of a sweep fails, or does less than was asked.

   EHLWAVE_FAULT = "CALL NUMBER ERRNO TIMES PART": of the calls of open, read, write, fsync, lock, rename, unlink or mkdir that
   concern a path with PART in it, those from NUMBER (1, 2, ...) on, TIMES of them, fail with ERRNO. ERRNO 0: write and read do
   half of what was asked, fsync waits 0.3 s. At the end of the process the number of such calls is appended to the file that
   EHLWAVE_FAULT_COUNT names, if that is set.

   EHLWAVE_DEATH = "CALL NUMBER RANK": the MPI rank of that number is killed when it makes a call of MPI, as mpi_bcast, for the
   NUMBERth time. Open MPI's names of the calls from Fortran (mpi_f08). */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

static char wanted[16], part[256];
static int number, error, times, calls, is_ready;

__attribute__((constructor)) static void read_fault(void)
{
   const char *text = getenv("EHLWAVE_FAULT");
   is_ready = text && sscanf(text, "%15s %d %d %d %255s", wanted, &number, &error, &times, part) == 5;
}

__attribute__((destructor)) static void tell_count(void)
{
   const char *name = getenv("EHLWAVE_FAULT_COUNT");
   FILE *file = name && is_ready ? fopen(name, "a") : NULL;
   if (!file) return;
   is_ready = 0;
   fprintf(file, "%d\n", calls);
   fclose(file);
}

/* Whether this call is one of those that go wrong. */
static int hits(const char *call, const char *path)
{
   if (!is_ready || strcmp(call, wanted) != 0 || !strstr(path, part)) return 0;
   calls++;
   return calls >= number && calls - number < times;
}

static int hits_file(const char *call, int file)
{
   char link[64], path[4096];
   if (!is_ready || strcmp(call, wanted) != 0) return 0;
   snprintf(link, sizeof link, "/proc/self/fd/%d", file);
   ssize_t length = readlink(link, path, sizeof path - 1);
   if (length < 0) return 0;
   path[length] = 0;
   return hits(call, path);
}

#define NEXT(type, name, ...) type (*next)(__VA_ARGS__) = (type (*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)
#define FAIL do { errno = error; return -1; } while (0)

static mode_t mode_of(int flags, va_list list) { return flags & (O_CREAT | O_TMPFILE) ? va_arg(list, mode_t) : 0; }

#define OPEN(name) \
   int name(const char *path, int flags, ...) \
   { \
      va_list list; \
      NEXT(int, #name, const char *, int, ...); \
      va_start(list, flags); \
      mode_t mode = mode_of(flags, list); \
      va_end(list); \
      if (hits("open", path) && error) FAIL; \
      return next(path, flags, mode); \
   }
OPEN(open)
OPEN(open64)

ssize_t read(int file, void *buffer, size_t size)
{
   NEXT(ssize_t, "read", int, void *, size_t);
   if (hits_file("read", file)) {
      if (error) FAIL;
      size = size > 1 ? size/2 : size;
   }
   return next(file, buffer, size);
}

ssize_t write(int file, const void *buffer, size_t size)
{
   NEXT(ssize_t, "write", int, const void *, size_t);
   if (hits_file("write", file)) {
      if (error == ENOSPC && size > 1) {   /* as disks do: a part fits */
         ssize_t written = next(file, buffer, size/2);
         if (written > 0 && times > 1) return written;
      }
      if (error) FAIL;
      size = size > 1 ? size/2 : size;
   }
   return next(file, buffer, size);
}

int fsync(int file)
{
   NEXT(int, "fsync", int);
   if (hits_file("fsync", file)) {
      struct timespec pause = {0, 300000000};
      if (error) FAIL;
      nanosleep(&pause, NULL);
   }
   return next(file);
}

/* Both kinds of locks are "lock": of whole files, as HDF5 takes them, and of parts, as the programs do. */
int flock(int file, int operation)
{
   NEXT(int, "flock", int, int);
   if (hits_file("lock", file) && error) FAIL;
   return next(file, operation);
}

#define LOCKF(name, offset) \
   int name(int file, int command, offset length) \
   { \
      NEXT(int, #name, int, int, offset); \
      if (hits_file("lock", file) && error) FAIL; \
      return next(file, command, length); \
   }
LOCKF(lockf, off_t)
LOCKF(lockf64, off64_t)

int rename(const char *old, const char *new)
{
   NEXT(int, "rename", const char *, const char *);
   if (hits("rename", new) && error) FAIL;
   return next(old, new);
}

int unlink(const char *path)
{
   NEXT(int, "unlink", const char *);
   if (hits("unlink", path) && error) FAIL;
   return next(path);
}

int mkdir(const char *path, mode_t mode)
{
   NEXT(int, "mkdir", const char *, mode_t);
   if (hits("mkdir", path) && error) FAIL;
   return next(path, mode);
}

/* Whether this rank is to die in this call. */
static int dies(const char *call)
{
   static int seen;
   char name[32];
   int last, rank;
   const char *text = getenv("EHLWAVE_DEATH"), *own = getenv("OMPI_COMM_WORLD_RANK");
   return text && own && sscanf(text, "%31s %d %d", name, &last, &rank) == 3 && strcmp(call, name) == 0 && atoi(own) == rank &&
          ++seen == last;
}

/* All arguments are addresses, at most eight. */
#define MPI_CALL(name) \
   void name##_f08_(void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h) \
   { \
      NEXT(void, #name "_f08_", void *, void *, void *, void *, void *, void *, void *, void *); \
      if (dies(#name)) raise(SIGKILL); \
      next(a, b, c, d, e, f, g, h); \
   }
MPI_CALL(mpi_init)
MPI_CALL(mpi_bcast)
MPI_CALL(mpi_allreduce)
MPI_CALL(mpi_send)
MPI_CALL(mpi_isend)
MPI_CALL(mpi_recv)
MPI_CALL(mpi_finalize)
