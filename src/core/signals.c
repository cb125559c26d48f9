/* Signals of POSIX: caught and noted, ignored, a watchdog, work that a signal may end. The interfaces are in posix.f90. */
#define _DEFAULT_SOURCE
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t caught = 0;
static volatile sig_atomic_t note_length = 0;
static int note_file = -1;
static char note[256];

static void catch_signal(int number)
{
   int kept = errno;
   caught = number;
   if (note_length > 0 && write(note_file, note, (size_t)note_length) >= 0) note_length = 0;
   errno = kept;
}

/* From now on SIGTERM, SIGUSR1, SIGINT and SIGXCPU are remembered; a second SIGINT ends the process as usual. */
void ehlwave_catch_signals(void)
{
   struct sigaction action;
   memset(&action, 0, sizeof action);
   action.sa_handler = catch_signal;
   action.sa_flags = SA_RESTART;
   sigemptyset(&action.sa_mask);
   sigaction(SIGTERM, &action, NULL);
   sigaction(SIGUSR1, &action, NULL);
   sigaction(SIGXCPU, &action, NULL);
   action.sa_flags = SA_RESTART | SA_RESETHAND;
   sigaction(SIGINT, &action, NULL);
}

/* A process that has used up its processor time ends with a line and status 4, unless `ehlwave_catch_signals` remembers it. */
static void end_for_time(int number)
{
   static const char text[] = "ehlwave: the processor time is used up that this process may have (ulimit -t)\n";
   (void)number;
   _exit(write(STDERR_FILENO, text, sizeof text - 1) < 0 ? 3 : 4);
}

/* From now on it is an error of writing, and not the end of the process, that nobody reads its output any more (EPIPE) or
   that a file would be longer than allowed (EFBIG, as of a full disk). */
void ehlwave_ignore_write_signals(void)
{
   signal(SIGPIPE, SIG_IGN);
   signal(SIGXFSZ, SIG_IGN);
   signal(SIGXCPU, end_for_time);
}

int ehlwave_is_broken_pipe(int status) { return status == EPIPE; }

int ehlwave_signal_caught(void) { return caught; }

/* What the first signal appends to a file, at once: whoever sends it may not wait. Length 0: nothing. */
int ehlwave_set_note(int file, const char *text, long length)
{
   note_length = 0;
   if (length > (long)sizeof note) return EMSGSIZE;
   memcpy(note, text, (size_t)length);
   note_file = file;
   note_length = (sig_atomic_t)length;
   return 0;
}

/* End this process by SIGALRM unless called again within some seconds; 0: never. */
void ehlwave_watchdog(int seconds)
{
   signal(SIGALRM, SIG_DFL);
   alarm((unsigned)(seconds > 0 ? seconds : 0));
}

static sigjmp_buf before_work;

static void give_up_work(int signal)
{
   siglongjmp(before_work, signal);
}

/* Do work that may break down in a library: 0, or the signal that ended it. What the library holds is lost then. Not for several
   threads at once. */
int ehlwave_guarded(void (*work)(void))
{
   static const int signals[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
   enum { COUNT = sizeof signals/sizeof signals[0] };
   static char space[65536];   /* a stack that has overflowed cannot hold the handler */
   stack_t own = {.ss_sp = space, .ss_size = sizeof space}, old_stack;
   struct sigaction action = {.sa_handler = give_up_work, .sa_flags = SA_ONSTACK}, old[COUNT];
   volatile int ended_by;

   sigemptyset(&action.sa_mask);
   sigaltstack(&own, &old_stack);
   for (int i = 0; i < COUNT; i++) sigaction(signals[i], &action, &old[i]);
   ended_by = sigsetjmp(before_work, 1);
   if (!ended_by) work();
   for (int i = 0; i < COUNT; i++) sigaction(signals[i], &old[i], NULL);
   sigaltstack(&old_stack, NULL);
   return ended_by;
}
