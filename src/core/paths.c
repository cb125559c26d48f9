/* What is needed of POSIX for names: which file one leads to, removing without following links.
   Functions return 0 or an errno value unless they say otherwise. The interfaces are in paths.f90. */
#define _DEFAULT_SOURCE
#define _XOPEN_SOURCE 700
#define _FILE_OFFSET_BITS 64
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Whether two names lead to the same file, through links too, and by whatever name: 1, else 0. */
int ehlwave_is_same(const char *one, const char *other)
{
   struct stat a, b;
   return stat(one, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/* The full name of what a path leads to, without links, ended by a zero; empty if it cannot be told or is too long. */
void ehlwave_real_path(const char *path, char *name, long size)
{
   char *full = realpath(path, NULL);
   name[0] = 0;
   if (full && (long)strlen(full) < size) strcpy(name, full);
   free(full);
}

/* Remove a file of a folder, or of the folder `part` in it if that is not empty. Neither the folders nor the file are links that
   would be followed: ENOTDIR or ELOOP where a folder is one. A file that is not there is no error. */
int ehlwave_remove_within(const char *folder, const char *part, const char *name)
{
   const int flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
   int outer = open(folder, flags), inner, status = 0;
   if (outer < 0) return errno == ENOENT ? 0 : errno;
   inner = *part ? openat(outer, part, flags) : outer;
   if (inner < 0 || unlinkat(inner, name, 0) != 0) status = errno;
   if (inner >= 0 && inner != outer) close(inner);
   close(outer);
   return status == ENOENT ? 0 : status;
}

/* Remove an empty folder; a link to one is none. */
int ehlwave_remove_folder(const char *path)
{
   return rmdir(path) == 0 || errno == ENOENT ? 0 : errno;
}
