// What a process sees whose file system cannot bring folders to disk: fsync() of a folder fails with the error whose
// number is FSYNC_ERROR.
//
//   cc -shared -fPIC -o unsynced.so unsynced.c
//   LD_PRELOAD=./unsynced.so FSYNC_ERROR=5 itin job run job
#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

int fsync(int file) {
  struct stat status;
  if (fstat(file, &status) == 0 && S_ISDIR(status.st_mode)) {
    errno = atoi(getenv("FSYNC_ERROR"));
    return -1;
  }
  return (int)syscall(SYS_fsync, file);
}
