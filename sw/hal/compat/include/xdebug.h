#ifndef XDEBUG_H
#define XDEBUG_H

/* Debug messages: printed where DEBUG is defined. */

#include <stdio.h>

#define XDBG_DEBUG_ERROR 0x00000001U
#define XDBG_DEBUG_GENERAL 0x00000002U
#define XDBG_DEBUG_ALL 0xFFFFFFFFU

#if defined(DEBUG) && !defined(NDEBUG)
#ifndef xdbg_current_types
#define xdbg_current_types (XDBG_DEBUG_GENERAL | XDBG_DEBUG_ERROR)
#endif
#define xdbg_stmnt(x) x
#define xdbg_printf(type, ...) (((type)&xdbg_current_types) ? printf(__VA_ARGS__) : 0)
#else
#define xdbg_stmnt(x)
#define xdbg_printf(...) ((void)0)
#endif

#endif
