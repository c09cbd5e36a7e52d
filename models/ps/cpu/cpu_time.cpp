#include <ps/cpu/cpu_time.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <vp/error.h>
#include <vp/text.h>

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

namespace {

constexpr double most_per_unit = 1e9;
constexpr double fs_per_ns = 1e6;
constexpr double one_cycle = static_cast<double>(LocalTime::one_cycle);

void check(const std::string& profile, const std::string& work, const char* what, double value) {
  if (std::isfinite(value) && value >= 0 && value <= most_per_unit) return;
  throw vp::InputError("cost table '" + profile + "': the " + what + " of '" + work + "' are " +
                       std::to_string(value) + ": give a number from 0 to 1e9");
}

}  // namespace

void CostTable::set(const std::string& work, const WorkCost& cost) {
  check(profile_, work, "cycles", cost.cycles);
  check(profile_, work, "stalls (ns)", cost.stall_ns);
  entries_[work] = cost;
}

const WorkCost& CostTable::at(const std::string& work, const std::string& program) const {
  const auto entry = entries_.find(work);
  if (entry != entries_.end()) return entry->second;
  std::vector<std::string> names;
  for (const auto& [name, cost] : entries_) names.push_back(name);
  const std::string nearest = vp::nearest_match(work, names);
  throw vp::InputError("cost table '" + profile_ + "' has no entry for '" + work +
                       "', a unit of work of program '" + program +
                       "': add it to other_units of a profile of your own" +
                       (nearest.empty() ? "" : " (nearest entry: '" + nearest + "')"));
}

void WorkMeter::load(const hal_program& program, const CostTable& costs) {
  program_ = &program;
  units_.clear();
  for (std::uint32_t i = 0; i < program.work_count; ++i) {
    const WorkCost& cost = costs.at(program.work[i], program.name);
    Unit unit;
    unit.cycles = static_cast<LocalTime::Wide>(std::llround(cost.cycles * one_cycle));
    unit.stall_fs = static_cast<LocalTime::Wide>(std::llround(cost.stall_ns * fs_per_ns));
    units_.push_back(unit);
  }
}

void WorkMeter::set_frequency(std::uint64_t hertz) {
  const LocalTime::Wide denominator = LocalTime::Wide{hertz} << LocalTime::fraction_bits;
  for (Unit& unit : units_)
    unit.most_fs = unit.cycles * LocalTime::fs_per_second / denominator + 1 + unit.stall_fs;
}

void WorkMeter::set_code_cycles(double cycles) {
  code_unit_ = static_cast<std::uint64_t>(std::llround(cycles * one_cycle));
}

std::vector<WorkCount> WorkMeter::counts() const {
  std::vector<WorkCount> counts;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const Unit& unit = units_[i];
    counts.push_back({program_->work[i], unit.count, static_cast<double>(unit.cycles) / one_cycle,
                      static_cast<double>(unit.stall_fs) / fs_per_ns});
  }
  return counts;
}

WorkMeter::Counted WorkMeter::counted() const {
  Counted sum;
  for (const Unit& unit : units_) {
    sum.cycles += unit.cycles * unit.count;
    sum.stall_fs += unit.stall_fs * unit.count;
  }
  sum.cycles += code_cycles_;
  return sum;
}

}  // namespace ps
