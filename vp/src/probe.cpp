#include <vp/probe.h>

namespace vp {

ProbeBase::ProbeBase(const char* name, unsigned width, const void* address, std::size_t byte_count)
    : SignalBase(name), width_(width), address_(address), byte_count_(byte_count) {}

// Nobody writes through a probe.
void ProbeBase::commit() {}

}  // namespace vp
