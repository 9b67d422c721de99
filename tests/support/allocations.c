/* Loaded before the C library: counts the allocations of the present thread, and lets some fail. */
#include <errno.h>
#include <stddef.h>

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

static __thread long count;
/* The allocation that fails, from 1; 0 for none. */
static __thread long failing;
/* Whether all allocations from it on fail. */
static __thread int all;

/* Begins to count; allocation number `first` fails and, if `and_all`, those after it. */
void allocations_begin(long first, int and_all) {
    count = 0;
    failing = first;
    all = and_all;
}

/* Ends the failing, and returns the number of allocations since allocations_begin. */
long allocations_end(void) {
    failing = 0;
    return count;
}

static int fails(void) {
    ++count;
    int is = failing != 0 && (count == failing || (all && count > failing));
    if (is) errno = ENOMEM;
    return is;
}

void *malloc(size_t size) { return fails() ? NULL : __libc_malloc(size); }
void *calloc(size_t n, size_t size) { return fails() ? NULL : __libc_calloc(n, size); }
void *realloc(void *p, size_t size) { return fails() ? NULL : __libc_realloc(p, size); }
void *memalign(size_t a, size_t size) { return fails() ? NULL : __libc_memalign(a, size); }
void *aligned_alloc(size_t a, size_t size) { return memalign(a, size); }

int posix_memalign(void **p, size_t alignment, size_t size) {
    if (fails()) return ENOMEM;
    *p = __libc_memalign(alignment, size);
    return *p == NULL ? ENOMEM : 0;
}
