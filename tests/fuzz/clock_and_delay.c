// What a process sees whose machine has another clock than the file server, and whose file server is slow: SHIFT_S
// seconds are added to the time of day, and calls about files in SLOW_FOLDER take DELAY_MS milliseconds longer. The
// times of files stay those of the file server.
//
//   cc -shared -fPIC -o clock_and_delay.so clock_and_delay.c -ldl
//   LD_PRELOAD=./clock_and_delay.so SHIFT_S=7200 SLOW_FOLDER=/shared DELAY_MS=20 itin job run /shared/job
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static double number(const char* variable) {
  const char* text = getenv(variable);
  return text ? atof(text) : 0;
}

static void wait_for_server(const char* path) {
  const char* folder = getenv("SLOW_FOLDER");
  if (!folder || !path || (path[0] == '/' && strncmp(path, folder, strlen(folder)) != 0)) return;
  usleep((useconds_t)(1000 * number("DELAY_MS")));
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  const int failed = (int)syscall(SYS_clock_gettime, clock, now);
  if (!failed && clock == CLOCK_REALTIME) now->tv_sec += (time_t)number("SHIFT_S");
  return failed;
}

int gettimeofday(struct timeval* restrict now, void* restrict zone) {
  (void)zone;
  struct timespec exact;
  const int failed = clock_gettime(CLOCK_REALTIME, &exact);
  now->tv_sec = exact.tv_sec, now->tv_usec = exact.tv_nsec / 1000;
  return failed;
}

time_t time(time_t* result) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (result) *result = now.tv_sec;
  return now.tv_sec;
}

#define SLOW_OPEN(name)                                                   \
  int name(const char* path, int flags, ...) {                            \
    va_list rest;                                                         \
    va_start(rest, flags);                                                \
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0; \
    va_end(rest);                                                         \
    wait_for_server(path);                                                \
    return NEXT(name)(path, flags, mode);                                 \
  }
SLOW_OPEN(open)
SLOW_OPEN(open64)

#define SLOW_FOPEN(name)                                             \
  FILE* name(const char* restrict path, const char* restrict mode) { \
    wait_for_server(path);                                           \
    return NEXT(name)(path, mode);                                   \
  }
SLOW_FOPEN(fopen)
SLOW_FOPEN(fopen64)

int stat(const char* restrict path, struct stat* restrict status) {
  wait_for_server(path);
  return NEXT(stat)(path, status);
}

int rename(const char* from, const char* to) {
  wait_for_server(to);
  return NEXT(rename)(from, to);
}

int link(const char* from, const char* to) {
  wait_for_server(to);
  return NEXT(link)(from, to);
}

int unlink(const char* path) {
  wait_for_server(path);
  return NEXT(unlink)(path);
}

int fsync(int file) {
  wait_for_server("");
  return NEXT(fsync)(file);
}
