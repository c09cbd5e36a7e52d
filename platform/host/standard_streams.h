#pragma once

#include <iosfwd>

namespace platform::host {

/// Makes sure that descriptors 0 to 2 are taken: otherwise the first file that is opened becomes
/// the standard output of a program that was started without one. Writing to them fails.
void fill_standard_descriptors();

/// Throws vp::OutputError if what went to `out` could not all be written. Call it right after
/// writing: errno says why.
void check_written(std::ostream& out);

/// The same for all that this process wrote to its standard output, also with printf(), and for
/// what the system tells only when the descriptor is closed.
void check_standard_output();

}  // namespace platform::host
