#include <vp/rule_reports.h>

#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/ip.h>
#include <vp/report.h>
#include <vp/unit.h>

namespace vp {

ProtocolChecks::ProtocolChecks(sc_core::sc_module_name name) : sc_module(name) {
  on_.fill(true);
  const Configuration* configuration = Configuration::current();
  for (std::size_t i = 0; configuration && i < rule_count; ++i) {
    const RuleInfo& rule = info_of(static_cast<Rule>(i));
    if (!configuration->find(std::string(this->name()) + "." + rule.name)) continue;
    set_.push_back(
        std::make_unique<Parameter<bool>>(rule.name, true, Source::published, rule.statement));
    on_[i] = *set_.back();
  }
}

void RuleReports::violate(Rule rule, const Clock* clock, const std::string& what) {
  if (!checks_) checks_ = dynamic_cast<const ProtocolChecks*>(sc_core::sc_find_object("checks"));
  if (*checks_ && !(*checks_)->watches(rule)) return;
  if (++counts_[static_cast<std::size_t>(rule)] != 1) return;
  const RuleInfo& info = info_of(rule);
  std::string text = std::string(info.name) + ": " + what + "; " + info.statement;
  if (clock) {
    text += " (edge " + std::to_string(clock->cycle()) + " of " + clock->name() + ", at " +
            format_time(clock->scheduler().now_ps()) + ")";
  }
  warn(link_, (std::string("/markervp/rule/") + info.name).c_str(), text);
}

void RuleReports::finish() const {
  for (std::size_t i = 0; i < rule_count; ++i) {
    if (counts_[i] < 2) continue;
    info(link_, "/markervp/rule/count",
         std::string(info_of(static_cast<Rule>(i)).name) + " was broken " +
             std::to_string(counts_[i]) + " times",
         sc_core::SC_LOW);
  }
}

}  // namespace vp
