#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <vp/report.h>
#include <vp/unit.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace vp {
namespace {

constexpr const char* line_pattern = "%^%l%$: %v";

ReportRouter* current_router = nullptr;

/// The object that reports, while its report is on the way through SystemC's handler.
const sc_core::sc_object* reporting_object = nullptr;

class Reporting {
 public:
  explicit Reporting(const sc_core::sc_object& object) : outer_(reporting_object) {
    reporting_object = &object;
  }
  ~Reporting() { reporting_object = outer_; }
  Reporting(const Reporting&) = delete;
  Reporting& operator=(const Reporting&) = delete;

 private:
  const sc_core::sc_object* outer_;
};

/// The text also carries the name, for code that catches the report or runs without a router.
std::string prefix(const sc_core::sc_object& where) {
  return std::string(where.name()) + ": ";
}

void send(const sc_core::sc_object& where, sc_core::sc_severity severity, const char* id,
          const std::string& message, int verbosity) {
  const Reporting reporting(where);
  sc_core::sc_report_handler::report(severity, id, (prefix(where) + message).c_str(), verbosity, "",
                                     0);
}

spdlog::level::level_enum level(sc_core::sc_severity severity) {
  switch (severity) {
    case sc_core::SC_INFO:
      return spdlog::level::info;
    case sc_core::SC_WARNING:
      return spdlog::level::warn;
    case sc_core::SC_ERROR:
      return spdlog::level::err;
    default:
      return spdlog::level::critical;
  }
}

std::shared_ptr<spdlog::logger> make_logger(const spdlog::sink_ptr& sink) {
  auto logger = std::make_shared<spdlog::logger>("markervp", sink);
  logger->set_pattern(line_pattern);
  logger->set_level(spdlog::level::trace);
  logger->flush_on(spdlog::level::trace);
  return logger;
}

}  // namespace

void info(const sc_core::sc_object& where, const char* id, const std::string& message,
          int verbosity) {
  send(where, sc_core::SC_INFO, id, message, verbosity);
}

void warn(const sc_core::sc_object& where, const char* id, const std::string& message) {
  send(where, sc_core::SC_WARNING, id, message, sc_core::SC_NONE);
}

void error(const sc_core::sc_object& where, const char* id, const std::string& message) {
  send(where, sc_core::SC_ERROR, id, message, sc_core::SC_NONE);
  // Reached only if SC_ERROR was configured not to throw; no model continues after an error.
  throw std::runtime_error(prefix(where) + message);
}

ReportRouter::ReportRouter(int verbosity)
    : logger_(make_logger(std::make_shared<spdlog::sinks::stderr_color_sink_st>())),
      now_ps_([] { return sc_core::sc_time_stamp().value(); }),
      outer_(current_router),
      old_handler_(sc_core::sc_report_handler::get_handler()),
      old_verbosity_(sc_core::sc_report_handler::set_verbosity_level(verbosity)) {
  using sc_core::sc_report_handler;
  for (int severity = sc_core::SC_INFO; severity < sc_core::SC_MAX_SEVERITY; ++severity) {
    sc_core::sc_actions actions = sc_core::SC_DISPLAY;
    if (severity >= sc_core::SC_ERROR) actions |= sc_core::SC_CACHE_REPORT | sc_core::SC_THROW;
    old_actions_[severity] =
        sc_report_handler::set_actions(static_cast<sc_core::sc_severity>(severity), actions);
  }
  sc_report_handler::set_handler(&ReportRouter::handle);
  current_router = this;
}

ReportRouter::~ReportRouter() {
  finish();
  using sc_core::sc_report_handler;
  sc_report_handler::set_handler(old_handler_);
  for (int severity = sc_core::SC_INFO; severity < sc_core::SC_MAX_SEVERITY; ++severity) {
    sc_report_handler::set_actions(static_cast<sc_core::sc_severity>(severity),
                                   old_actions_[severity]);
  }
  sc_report_handler::set_verbosity_level(old_verbosity_);
  current_router = outer_;
}

void ReportRouter::redirect(std::ostream& stream) {
  logger_ = make_logger(std::make_shared<spdlog::sinks::ostream_sink_st>(stream));
}

std::uint64_t ReportRouter::count(const std::string& id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? 0 : found->second;
}

void ReportRouter::handle(const sc_core::sc_report& report, const sc_core::sc_actions& actions) {
  current_router->route(report);
  const bool fails =
      report.get_severity() == sc_core::SC_WARNING && current_router->fail_on_warning_;
  if (fails || (actions & sc_core::SC_THROW)) throw sc_core::sc_report(report);
  // What else was asked for (SC_STOP, SC_ABORT, …) is done by the default handler; it prints
  // nothing.
  sc_core::sc_report_handler::default_handler(
      report, actions & ~static_cast<sc_core::sc_actions>(sc_core::SC_DISPLAY));
}

void ReportRouter::route(const sc_core::sc_report& report) {
  Warning entry{report.get_msg_type(), "", report.get_msg(), now_ps_()};
  if (reporting_object != nullptr) {
    entry.where = reporting_object->name();
    entry.message.erase(0, prefix(*reporting_object).size());
  } else if (report.get_process_name() != nullptr) {
    entry.where = report.get_process_name();
  }
  ++by_severity_[report.get_severity()];
  const std::uint64_t repeats = ++by_id_[entry.id];
  const bool warns = report.get_severity() == sc_core::SC_WARNING;
  if (warns && warnings_.size() < kept_limit) warnings_.push_back(entry);
  const bool stops = report.get_severity() >= sc_core::SC_ERROR;
  const bool prints = stops || repeats <= repeat_limit;
  if (!prints && !(warns && warning_listener_)) return;
  const bool wants_place = report.get_severity() != sc_core::SC_INFO && place_;
  const Line line{report.get_severity(), std::move(entry), wants_place, prints,
                  !stops && repeats == repeat_limit};
  std::optional<std::string> place;
  if (wants_place) {
    place = place_();
  } else if (waiting_.empty()) {
    place = "";
  }
  if (place || stops) {
    finish();
    give(line, place.value_or(""));
  } else {
    waiting_.push_back(line);
    lines_wait_ = true;
  }
}

void ReportRouter::give(const Line& line, const std::string& place) {
  if (line.prints) {
    std::string text = line.report.where.empty() ? "" : line.report.where + ": ";
    text +=
        line.report.message + " [" + line.report.id + "] at " + format_time(line.report.time_ps);
    if (line.wants_place && !place.empty()) text += ", " + place;
    if (line.is_last) text += " (further ones are only counted)";
    std::replace(text.begin(), text.end(), '\n', ' ');
    logger_->log(level(line.severity), "{}", text);
  }
  if (line.severity == sc_core::SC_WARNING && warning_listener_) warning_listener_(line.report);
}

// Asked from elsewhere than the software it is not known yet.
void ReportRouter::print_waiting_lines() {
  if (current_router == nullptr || !current_router->place_) return;
  const std::optional<std::string> place = current_router->place_();
  if (place) current_router->print_waiting_lines(*place);
}

void ReportRouter::print_waiting_lines(const std::string& place) {
  lines_wait_ = false;
  for (const Line& line : std::exchange(waiting_, {})) give(line, place);
}

void ReportRouter::finish() {
  print_waiting_lines("");
}

}  // namespace vp
