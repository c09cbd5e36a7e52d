#include <ps/cpu/activity.h>
#include <algorithm>

namespace ps {

void Activity::start(const hal_program& program) {
  *this = Activity();
  for (std::uint32_t i = 0; i < program.function_count; ++i) {
    functions_.push_back({program.functions[i], 0, 0, 0});
  }
}

void Activity::assign() const {
  busy_ps_ += unassigned_ps_;
  if (in_handler_) handler_ps_ += unassigned_ps_;
  if (stack_.size() > handler_base_) functions_[stack_.back().function].self_ps += unassigned_ps_;
  unassigned_ps_ = 0;
}

const std::vector<FunctionTime>& Activity::functions() const {
  assign();
  return functions_;
}

void Activity::enter_handler() {
  assign();
  handler_base_ = stack_.size();
  in_handler_ = true;
}

void Activity::leave_handler() {
  assign();
  handler_base_ = 0;
  in_handler_ = false;
}

void Activity::enter(std::uint32_t function, std::uint64_t now_ps) {
  assign();
  stack_.push_back({function, now_ps});
  ++functions_[function].calls;
}

void Activity::leave(std::uint64_t now_ps) {
  assign();
  const Frame frame = stack_.back();
  stack_.pop_back();
  const bool nested = std::any_of(stack_.begin(), stack_.end(),
                                  [&](const Frame& f) { return f.function == frame.function; });
  if (!nested) functions_[frame.function].total_ps += now_ps - frame.entered_ps;
}

}  // namespace ps
