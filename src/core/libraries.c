/* Shared libraries: their procedures and texts. The interfaces are in posix.f90. */
#define _DEFAULT_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif

/* A function of a shared library, whose symbols stay its own. The library is loaded if `loads`, else it must have been.
   NULL if there is none; then the system's words for why stand in `reason`, cut to its size, and end with a zero. */
void (*ehlwave_find_procedure(const char *library, const char *name, int loads, char *reason, long size))(void)
{
   void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL | (loads ? 0 : RTLD_NOLOAD));
   void *address = handle ? dlsym(handle, name) : NULL;
   void (*procedure)(void) = NULL;
   const char *words = address ? "" : dlerror();
   snprintf(reason, (size_t)size, "%s", words ? words : "not loaded");
   memcpy(&procedure, &address, sizeof procedure);   /* ISO C has no conversion of one into the other, POSIX has */
   return procedure;
}

/* The text in an array of characters that a library has for all, such as fftw_version of FFTW, cut to `size` and ended by a
   zero; empty if no library that the program was started with has it. Without a name: name and version of the C library,
   whose vector functions results depend on; empty if it does not say. */
void ehlwave_library_text(const char *name, char *text, long size)
{
   void *handle = dlopen(NULL, RTLD_NOW);
   const char *found = handle && *name ? dlsym(handle, name) : NULL;
   snprintf(text, (size_t)size, "%s", found ? found : "");
   if (handle) dlclose(handle);
#ifdef __GLIBC__
   if (!*name) snprintf(text, (size_t)size, "glibc %s", gnu_get_libc_version());
#endif
}
