#pragma once

namespace vp {

/// Makes SystemC begin again: what is built from here on is another simulation, and time is 0. What
/// was built before must be gone. SystemC 2.3.4 cannot destroy its old context safely: each call
/// costs memory until the process ends, about 50 KiB for the whole platform (measured).
void begin_fresh_context();

}  // namespace vp
