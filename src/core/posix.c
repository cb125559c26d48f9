/* Files, folders and locks of POSIX that Fortran has no words for: durable appending and replacing, names, contents, locks.
   Functions return 0 or an errno value unless they say otherwise. The interfaces are in posix.f90. */
#define _DEFAULT_SOURCE
#define _FILE_OFFSET_BITS 64
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { NOT_REGULAR = 10000 };   /* beside the system's error numbers: a folder, a pipe or a device where a file should be */

#ifdef EHLWAVE_NEEDS_AVX2
/* Before a program starts: say what it would die of. Exit status 2. */
__attribute__((constructor)) static void need_avx2(void)
{
   __builtin_cpu_init();
   if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return;
   fputs("ehlwave was built for processors with AVX2 and FMA, which this one lacks: build it with -DEHLWAVE_AVX2=OFF\n", stderr);
   _exit(2);
}
#endif

/* Before a program opens anything: a standard stream that is closed would be its next file or pipe. Nothing can be written to
   what holds its place, so that a closed standard output is noticed as before. */
__attribute__((constructor)) static void hold_standard_streams(void)
{
   int file;
   do file = open("/dev/null", O_RDONLY);
   while (file >= 0 && file <= STDERR_FILENO);
   if (file >= 0) close(file);
}

/* Place of the first or last byte of a kind in a text, counted from 1; 0: there is none. */
long ehlwave_find(const char *text, long length, int byte, int backward)
{
   long place = 0;
   for (const char *found = text; place < length && (found = memchr(text + place, byte, (size_t)(length - place)));) {
      place = found - text + 1;
      if (!backward) break;
   }
   return place;
}

/* CRC-32 of ISO 3309 (that of zlib and PNG). */
uint32_t ehlwave_crc32(const unsigned char *text, long length)
{
   static uint32_t table[256];
   uint32_t crc = 0xffffffffu;
   if (table[1] == 0)
      for (uint32_t i = 0; i < 256; i++) {
         uint32_t value = i;
         for (int bit = 0; bit < 8; bit++) value = value & 1 ? 0xedb88320u ^ (value >> 1) : value >> 1;
         table[i] = value;
      }
   for (long i = 0; i < length; i++) crc = table[(crc ^ text[i]) & 255] ^ (crc >> 8);
   return crc ^ 0xffffffffu;
}

/* Make the name of a new file durable, too. Some file systems refuse to sync a folder: not an error. */
static void sync_folder_of(const char *path)
{
   char folder[4096];
   const char *slash = strrchr(path, '/');
   size_t length = slash ? (size_t)(slash - path) : 0;
   if (length >= sizeof folder) return;
   memcpy(folder, path, length);
   strcpy(folder + length, length ? "" : ".");
   int file = open(folder, O_RDONLY);
   if (file < 0) return;
   fsync(file);
   close(file);
}

/* A new file for appending, or an errno value with a minus; a file that exists is an error (EEXIST). */
int ehlwave_create(const char *path)
{
   int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
   if (file < 0) return -errno;
   sync_folder_of(path);
   return file;
}

/* Append all of a text in one call as long as the system takes it so. */
int ehlwave_append(int file, const char *text, long length)
{
   while (length > 0) {
      ssize_t written = write(file, text, (size_t)length);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      if (written == 0) return ENOSPC;
      text += written;
      length -= written;
   }
   return 0;
}

int ehlwave_sync(int file) { return fsync(file) == 0 ? 0 : errno; }

int ehlwave_close(int file) { return close(file) == 0 ? 0 : errno; }

/* What stands under a name, links not followed: 0 nothing, 1 a regular file, 2 a folder, 3 a link, 4 anything else;
   an errno value with a minus if that cannot be found out. */
int ehlwave_kind(const char *path)
{
   struct stat there;
   if (lstat(path, &there) != 0) return errno == ENOENT ? 0 : -errno;
   return S_ISREG(there.st_mode) ? 1 : S_ISDIR(there.st_mode) ? 2 : S_ISLNK(there.st_mode) ? 3 : 4;
}

/* A regular file for reading, and its length; or an errno value with a minus, NOT_REGULAR if it is anything else. */
int ehlwave_open(const char *path, long *bytes)
{
   struct stat there;
   int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
   if (file < 0) return -errno;
   int status = fstat(file, &there) != 0 ? errno : S_ISREG(there.st_mode) ? 0 : S_ISDIR(there.st_mode) ? EISDIR : NOT_REGULAR;
   *bytes = status == 0 ? (long)there.st_size : 0;
   if (status == 0) return file;
   close(file);
   return -status;
}

/* Read until a buffer is full or the file ends. Returns the number of bytes, or an errno value with a minus. */
long ehlwave_read(int file, char *buffer, long size)
{
   long length = 0;
   while (length < size) {
      ssize_t n = read(file, buffer + length, (size_t)(size - length));
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return -errno;
      if (n == 0) break;
      length += n;
   }
   return length;
}

static const char temporary_mark[] = ".part-", random_letters[] = "abcdefghijklmnopqrstuvwxyz012345";
enum { RANDOM_LETTERS = 8 };

/* A new file beside `path`, under a name that nothing had, locked as long as this process is at work on it. Its name is
   put into `name`. Returns the file, or an errno value with a minus. */
static int make_temporary(const char *path, char *name, size_t size)
{
   static unsigned long long state = 0;
   struct timespec now;
   clock_gettime(CLOCK_REALTIME, &now);
   state ^= ((unsigned long long)now.tv_nsec << 24) ^ ((unsigned long long)now.tv_sec << 4) ^ (unsigned long long)getpid();
   for (int attempt = 0; attempt < 100; attempt++) {
      int length = snprintf(name, size, "%s%s", path, temporary_mark);
      if (length < 0 || (size_t)length + RANDOM_LETTERS >= size) return -ENAMETOOLONG;
      for (int i = 0; i < RANDOM_LETTERS; i++) {
         state = state*6364136223846793005ULL + 1442695040888963407ULL;
         name[length++] = random_letters[state >> 59];
      }
      name[length] = 0;
      int file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (file >= 0) return lockf(file, F_TLOCK, 0) == 0 || errno != EBADF ? file : -EBADF;   /* not all systems have locks */
      if (errno != EEXIST) return -errno;
   }
   return -EEXIST;
}

/* Replace `path` by a text: complete under another name first, then renamed. */
int ehlwave_replace(const char *path, const char *text, long length)
{
   char temporary[4096];
   int file = make_temporary(path, temporary, sizeof temporary), status;
   if (file < 0) return -file;
   status = ehlwave_append(file, text, length);
   if (status == 0) status = ehlwave_sync(file);
   if (status == 0 && rename(temporary, path) != 0) status = errno;
   if (status != 0) unlink(temporary);
   if (close(file) != 0 && status == 0) status = errno;
   if (status == 0) sync_folder_of(path);
   return status;
}

/* Whether a file could be put under a name: 0, or the reason why not. */
int ehlwave_try(const char *path)
{
   char temporary[4096];
   int file = make_temporary(path, temporary, sizeof temporary), status = 0;
   if (file < 0) return -file;
   if (unlink(temporary) != 0) status = errno;
   close(file);
   return status;
}

/* Whether a name is one that `ehlwave_replace` gives to what it is at work on: 1, else 0. `of`: for this file; empty: for any. */
int ehlwave_is_temporary(const char *name, const char *of)
{
   const size_t mark = sizeof temporary_mark - 1, n = strlen(name);
   if (n <= mark + RANDOM_LETTERS) return 0;
   const char *end = name + n - RANDOM_LETTERS;
   return strncmp(end - mark, temporary_mark, mark) == 0 && strspn(end, random_letters) == RANDOM_LETTERS
      && (!*of || (n - RANDOM_LETTERS - mark == strlen(of) && strncmp(name, of, strlen(of)) == 0));
}

/* Remove what processes that died have left in a folder of `ehlwave_replace`, for the file `of` of it; empty: for any. */
void ehlwave_clear(const char *path, const char *of)
{
   DIR *folder = opendir(path);
   if (!folder) return;
   for (struct dirent *entry; (entry = readdir(folder));) {
      const char *name = entry->d_name;
      if (!ehlwave_is_temporary(name, of)) continue;
      struct stat there;
      int file = openat(dirfd(folder), name, O_WRONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC | O_NOCTTY);
      if (file < 0) continue;
      if (fstat(file, &there) == 0 && S_ISREG(there.st_mode) && lockf(file, F_TLOCK, 0) == 0) unlinkat(dirfd(folder), name, 0);
      close(file);
   }
   closedir(folder);
}

int ehlwave_make_folder(const char *path)
{
   if (mkdir(path, 0777) == 0) return 0;
   int status = errno;
   struct stat there;
   return stat(path, &there) == 0 && S_ISDIR(there.st_mode) ? 0 : status;
}

int ehlwave_remove(const char *path)
{
   return remove(path) == 0 || errno == ENOENT ? 0 : errno;
}

/* Names in a folder, a line each, into a buffer that may be too short. Returns the length of all, or an errno value with
   a minus. Names that begin with a dot or hold an end of line are none of ours. */
long ehlwave_list(const char *path, char *buffer, long size)
{
   DIR *folder = opendir(path);
   long length = 0;
   if (!folder) return -errno;
   for (struct dirent *entry; errno = 0, (entry = readdir(folder));) {
      long n = (long)strlen(entry->d_name);
      if (entry->d_name[0] == '.' || strchr(entry->d_name, '\n')) continue;
      if (length + n + 1 <= size) {
         memcpy(buffer + length, entry->d_name, (size_t)n);
         buffer[length + n] = '\n';
      }
      length += n + 1;
   }
   if (errno != 0) length = -errno;
   closedir(folder);
   return length;
}

/* Lock a file against other processes, on all nodes where the file system has locks. The system gives the lock
   back when the process ends, however it ends. 0: locked, 1: another has it, 2: cannot be locked, -1: no file. */
int ehlwave_lock(const char *path)
{
   int file = open(path, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
   if (file < 0) return -1;
   if (lockf(file, F_TLOCK, 0) == 0) return 0;
   return errno == EACCES || errno == EAGAIN ? 1 : 2;
}

/* Whether another process has locked a file: 1, else 0. */
int ehlwave_is_locked(const char *path)
{
   int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC), status;
   if (file < 0) return 0;
   status = lockf(file, F_TEST, 0) != 0 && (errno == EACCES || errno == EAGAIN);
   close(file);
   return status;
}

int ehlwave_process_id(void) { return (int)getpid(); }

/* The system's words for an error number, cut to `size` and ended by a zero. */
void ehlwave_reason(int number, char *text, long size)
{
   snprintf(text, (size_t)size, "%s", number == NOT_REGULAR ? "Is not a regular file" : strerror(number));
}
