#include <vp/rule_reports.h>

#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/ip.h>
#include <vp/report.h>
#include <vp/unit.h>

namespace vp {

ProtocolChecks::ProtocolChecks(sc_core::sc_module_name name) : sc_module(name) {
  on_.fill(true);
  read("watch", watch_, Source::decision, "whether links are watched at all");
  for (std::size_t i = 0; i < rule_count; ++i) {
    const RuleInfo& rule = info_of(static_cast<Rule>(i));
    read(rule.name, on_[i], Source::published, rule.statement);
  }
}

void ProtocolChecks::read(const std::string& name, bool& on, Source source, const char* text) {
  const Configuration* configuration = Configuration::current();
  if (!configuration || !configuration->find(std::string(this->name()) + "." + name)) return;
  set_.push_back(std::make_unique<Parameter<bool>>(name.c_str(), true, source, text));
  on = *set_.back();
}

bool links_are_watched() {
  const auto* checks = dynamic_cast<const ProtocolChecks*>(sc_core::sc_find_object("checks"));
  return !checks || checks->watch_links();
}

void RuleReports::violate(Rule rule, const Clock* clock, const std::string& what) {
  if (!checks_) checks_ = dynamic_cast<const ProtocolChecks*>(sc_core::sc_find_object("checks"));
  if (*checks_ && !((*checks_)->watch_links() && (*checks_)->watches(rule))) return;
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
