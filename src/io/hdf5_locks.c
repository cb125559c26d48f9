/* Locks that the HDF5 library takes on files. The interfaces are in hdf5_reading.f90. */
#define _DEFAULT_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

/* Let the HDF5 library open files without locks: file systems may refuse them, and other programs hold them while they only read.
   The programs replace files as a whole, so that what they open is complete. To be called before the library starts. */
static int heeds_locks = 1;
void ehlwave_waive_hdf5_locks(void)
{
   static const char name[] = "HDF5_USE_FILE_LOCKING";
   static int is_waived;
   const char *wish = getenv(name);
   if (is_waived) return;
   heeds_locks = !wish || (strcmp(wish, "FALSE") != 0 && strcmp(wish, "0") != 0);
   is_waived = setenv(name, "FALSE", 1) == 0;
}

/* Whether another program holds a file open for writing, as HDF5 locks it: 1, else 0, also where the file system has no locks, and
   where HDF5_USE_FILE_LOCKING=FALSE was set. */
int ehlwave_is_written_to(const char *path)
{
   int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY), status;
   if (file < 0) return 0;
   ehlwave_waive_hdf5_locks();
   status = heeds_locks && flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
   close(file);
   return status;
}
