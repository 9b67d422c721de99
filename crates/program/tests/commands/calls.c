/* Loaded into the program under test: writes the calls that bring a file to the disk and into its
   place to the file $CALLS. With $KILLED_AT_RENAME the process is killed instead of renaming. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static void note(const char *call, const char *path) {
    int file = open(getenv("CALLS"), O_WRONLY | O_APPEND | O_CREAT, 0644);
    dprintf(file, "%s %s\n", call, path);
    close(file);
}

int fsync(int file) {
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = readlink(link, path, sizeof path - 1);
    path[length < 0 ? 0 : length] = 0;
    note("fsync", path);
    int (*next)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
    return next(file);
}

int rename(const char *from, const char *to) {
    if (getenv("KILLED_AT_RENAME"))
        raise(SIGKILL);
    note("rename to", to);
    int (*next)(const char *, const char *) =
        (int (*)(const char *, const char *))dlsym(RTLD_NEXT, "rename");
    return next(from, to);
}
