#ifndef MARKERVP_PLATFORM_H
#define MARKERVP_PLATFORM_H

/* What the vendor's templates bring as platform.c, for a program whose folder does not: on this
 * processor both do nothing, as the boot code has switched the caches on. */

static inline void init_platform(void) {}
static inline void cleanup_platform(void) {}

#endif
