#include <ps/cpu/activity.h>
#include <algorithm>

namespace ps {

void Activity::start(const hal_program& program) {
  *this = Activity();
  for (std::uint32_t i = 0; i < program.function_count; ++i) {
    functions_.push_back({program.functions[i], 0, 0, 0});
  }
}

void Activity::enter(std::uint32_t function, std::uint64_t now_ps) {
  stack_.push_back({function, now_ps});
  ++functions_[function].calls;
}

void Activity::leave(std::uint64_t now_ps) {
  const Frame frame = stack_.back();
  stack_.pop_back();
  const bool nested = std::any_of(stack_.begin(), stack_.end(),
                                  [&](const Frame& f) { return f.function == frame.function; });
  if (!nested) functions_[frame.function].total_ps += now_ps - frame.entered_ps;
}

void Activity::busy(std::uint64_t ps, bool in_handler) {
  busy_ps_ += ps;
  if (in_handler) handler_ps_ += ps;
  if (stack_.size() > handler_base_) functions_[stack_.back().function].self_ps += ps;
}

}  // namespace ps
