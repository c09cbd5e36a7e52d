#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/protocol_rules.h>

namespace vp {

/// Which rules of links are watched: all, but for those that the configuration switches off,
/// `checks.AXI4STREAM_ERRM_TVALID_STABLE: false`; none with `checks.watch: false`. A platform has
/// one of these, named "checks"; the tree of parameters has only what is set.
class ProtocolChecks : public sc_core::sc_module {
 public:
  explicit ProtocolChecks(sc_core::sc_module_name name);
  bool watches(Rule rule) const { return on_[static_cast<std::size_t>(rule)]; }
  /// False: checkers need not look at anything.
  bool watch_links() const { return watch_; }

 private:
  void read(const std::string& name, bool& on, Source source, const char* text);

  std::array<bool, rule_count> on_;
  bool watch_ = true;
  std::vector<std::unique_ptr<Parameter<bool>>> set_;
};

/// Whether the checks of the platform watch links at all; true where it has none. From the start of
/// the simulation on.
bool links_are_watched();

/// What checkers find on one link: the first violation of a rule is a warning with rule, link,
/// clock and time; how often it was broken is said at the end.
class RuleReports {
 public:
  explicit RuleReports(const sc_core::sc_object& link) : link_(link) {}

  /// The rule was broken now, at an edge of `clock` if there is one.
  void violate(Rule rule, const Clock* clock, const std::string& what);
  std::uint64_t count(Rule rule) const { return counts_[static_cast<std::size_t>(rule)]; }
  /// At the end of the simulation.
  void finish() const;

 private:
  const sc_core::sc_object& link_;
  std::array<std::uint64_t, rule_count> counts_{};
  std::optional<const ProtocolChecks*> checks_;  ///< looked up once; null: the platform has none
};

}  // namespace vp
