#ifndef MARKERVP_HAL_OPTION_DATA_H
#define MARKERVP_HAL_OPTION_DATA_H

/*
 * Files that a user names for a program's options. Part of the HAL (hal.h), for the few programs
 * that take any.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The unit of an option that takes the name of a file (hal_option_info): its default and minimum
 * are 0, its maximum 1, and its value is 1 if the user names a file, else 0. */
#define HAL_UNIT_FILE "file"

/** What is in the file that the program's option number `option` names; its length is in `size`.
 * NULL and 0 if the user names none, and on the chip. Valid until the program ends. */
const void* hal_option_data(uint32_t option, size_t* size);

#ifdef __cplusplus
}
#endif

#endif
