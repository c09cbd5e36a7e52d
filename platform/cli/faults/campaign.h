#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <cli/faults/campaign_file.h>
#include <cli/faults/outcome.h>

namespace platform::cli {

/// How the outcome of a fault is known.
enum class Known {
  run,     ///< it was simulated
  record,  ///< the run without faults shows that it changes nothing
  twin,    ///< it does the same as one that was simulated
};
const char* to_string(Known known);

/// A fault of a campaign, and what came of it.
struct Shot {
  std::string fault;     ///< as `inject` takes it
  std::string of_class;  ///< of FaultSpace
  std::string module;    ///< in which it lies
  std::uint64_t at_ps = 0;
  Outcome outcome = Outcome::broken;
  std::uint64_t times = 0;  ///< how often it happened
  std::string sign;         ///< the first new warning, or what ended the run; may be empty
  Known known = Known::run;
};

struct Campaign {
  Witness right;            ///< the run without faults
  std::vector<Shot> shots;  ///< in the order in which they were drawn
};

/// Runs the platform once without faults, draws the faults, and runs it once more to see what they
/// would meet. Then it runs for each job: at the moment of each fault that has to be simulated this
/// run forks, and the copy has the fault and runs to its end. So a fault costs what follows it, and
/// each is what a run with `inject` would be. The result does not depend on `jobs`. `progress` is
/// called with the number of shots that are done. Throws vp::InputError for a campaign that cannot
/// be run, or a run that fails without a fault.
Campaign run_campaign(const CampaignFile& file, unsigned jobs,
                      const std::function<void(std::uint64_t)>& progress);

}  // namespace platform::cli
