/* Loaded before the C library: the n-th call that changes files fails, once, as on a disk without room; the others are handed on.
 *
 * FAULT_AT=n    which one fails, from 1 on; none without it
 * FAULT_COUNT   a file into which the number of these calls is written at the end
 *
 * Counted are calls that make, name, fill, cut, or force files to the disk, of regular files and folders alone. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long calls;

static int fails(void) {
    const char *at = getenv("FAULT_AT");
    long now = atomic_fetch_add(&calls, 1) + 1;
    if (at == NULL || now != atol(at)) return 0;
    errno = ENOSPC;
    return 1;
}

static int is_regular(int fd) {
    struct stat about;
    return fd > 2 && fstat(fd, &about) == 0 && (S_ISREG(about.st_mode) || S_ISDIR(about.st_mode));
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define OF_FILE(type, name, parameters, arguments)          \
    type name parameters {                                   \
        if (is_regular(fd) && fails()) return -1;            \
        return NEXT(name) arguments;                         \
    }
#define OF_NAME(name, parameters, arguments)                 \
    int name parameters {                                    \
        if (fails()) return -1;                              \
        return NEXT(name) arguments;                         \
    }

OF_FILE(ssize_t, write, (int fd, const void *from, size_t count), (fd, from, count))
OF_FILE(ssize_t, pwrite, (int fd, const void *from, size_t count, off_t at), (fd, from, count, at))
OF_FILE(ssize_t, pwrite64, (int fd, const void *from, size_t count, off64_t at), (fd, from, count, at))
OF_FILE(ssize_t, writev, (int fd, const struct iovec *from, int count), (fd, from, count))
OF_FILE(int, fsync, (int fd), (fd))
OF_FILE(int, fdatasync, (int fd), (fd))
OF_FILE(int, ftruncate, (int fd, off_t length), (fd, length))
OF_FILE(int, ftruncate64, (int fd, off64_t length), (fd, length))
OF_NAME(rename, (const char *from, const char *to), (from, to))
OF_NAME(mkdir, (const char *path, mode_t mode), (path, mode))

static int opens(int flags) {
    return (flags & O_ACCMODE) != O_RDONLY && fails();
}

#define OPEN(name)                                                              \
    int name(const char *path, int flags, ...) {                                \
        va_list rest;                                                           \
        va_start(rest, flags);                                                  \
        mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(rest, mode_t) : 0; \
        va_end(rest);                                                           \
        return opens(flags) ? -1 : NEXT(name)(path, flags, mode);               \
    }
OPEN(open)
OPEN(open64)

__attribute__((destructor)) static void tell(void) {
    const char *path = getenv("FAULT_COUNT");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (file == NULL) return;
    fprintf(file, "%ld\n", atomic_load(&calls));
    fclose(file);
}
