#pragma once

/*
 * Instructions that do nothing and that no compiler emits: marks for the counting plug-in. ARM
 * state only.
 */

#define MARK_START 0xe00aa00a /* and r10, r10, r10: a measurement begins */
#define MARK_STOP 0xe18aa00a  /* orr r10, r10, r10: it ends */
#define MARK_FLUSH 0xe1a0a00a /* mov r10, r10: both caches are empty from here on */
