#include <validation/validation.h>

#include <set>

#include <validation/jitter.h>

namespace platform::validation {

namespace {

double value_of(const std::vector<Published>& published, const std::string& id) {
  for (const Published& row : published) {
    if (row.id == id) return row.value;
  }
  return 0;
}

}  // namespace

Validation validate_runs(const Measured& measured, const profiles::CostProfile& profile,
                         const std::vector<Published>& published, std::uint32_t repetitions) {
  check_same_inputs(measured);
  Validation result;
  result.measured = {repeated(measured.hybrid, repetitions),
                     repeated(measured.ps_only, repetitions)};
  result.repetitions = repetitions;
  result.profile = measured.hybrid.profile;
  result.profile_origin = profile.origin;
  // With the tables of another optimisation the factors are no fit any more.
  const bool is_fit = profile.costs.profile() == result.profile;
  std::set<std::string> fitted_to;
  for (const profiles::FittedConstant& constant : profile.fitted) {
    result.fitted.push_back(constant);
    if (is_fit) fitted_to.insert(constant.published.begin(), constant.published.end());
  }
  result.rows = judge_rows(published, result.measured, fitted_to);
  result.gates = judge_gates(result.rows, result.measured);
  result.orders = study_orders(result.measured, value_of(published, "identification.hybrid"),
                               value_of(published, "speedup.features"), band_percent);
  result.turns = study_turns(result.measured, value_of(published, "speedup.rotation"));
  return result;
}

}  // namespace platform::validation
