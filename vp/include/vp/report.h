#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

namespace spdlog {
class logger;
}

namespace vp {

/// Reports of the models, through SystemC's report system. `id` is a stable literal:
/// "/markervp/axi_dma/decode".
///
/// info: progress, printed on request. warn: software programmed something illegal; the run
/// continues. error: the model or its configuration is wrong; throws sc_core::sc_report. Do not
/// build the message on a hot path.
void info(const sc_core::sc_object& where, const char* id, const std::string& message,
          int verbosity = sc_core::SC_MEDIUM);
void warn(const sc_core::sc_object& where, const char* id, const std::string& message);
[[noreturn]] void error(const sc_core::sc_object& where, const char* id,
                        const std::string& message);

/// A warning as it is kept for tests and result files.
struct Warning {
  std::string id;
  std::string where;  ///< hierarchical name; of the process for reports of others
  std::string message;
  std::uint64_t time_ps = 0;
};

/// While it lives, every SystemC report becomes one line on stderr with name and simulation time,
/// is counted, and warnings are kept; SC_ERROR and SC_FATAL throw sc_core::sc_report. Then the
/// handler and actions before it return.
class ReportRouter {
 public:
  /// Lines printed for one id; more are counted only. Errors are always printed.
  static constexpr std::uint64_t repeat_limit = 10;
  /// Warnings kept; more are counted only.
  static constexpr std::size_t kept_limit = 1000;

  /// Prints SC_INFO up to `verbosity`: SC_LOW for important ones only, SC_DEBUG for all, SC_NONE
  /// for none.
  explicit ReportRouter(int verbosity = sc_core::SC_LOW);
  ~ReportRouter();
  ReportRouter(const ReportRouter&) = delete;
  ReportRouter& operator=(const ReportRouter&) = delete;

  /// Prints to `stream` instead of stderr. It must live as long as the router.
  void redirect(std::ostream& stream);
  /// Where the simulation time in ps is taken from; default: sc_time_stamp(). For models that run
  /// ahead of it.
  void set_time_source(std::function<std::uint64_t()> now_ps) { now_ps_ = std::move(now_ps); }
  /// Where the software is, for the printed lines; empty: nowhere, or it is not running. nullopt:
  /// the software waits and its place is unknown until it resumes; lines are held until then.
  using PlaceSource = std::function<std::optional<std::string>()>;
  void set_place_source(PlaceSource place) { place_ = std::move(place); }
  /// Call wherever software may resume after a wait: prints the lines held for it.
  static void software_goes_on() {
    if (lines_wait_) print_waiting_lines();
  }
  /// Prints the held lines. Call when the simulation has ended.
  void finish();
  /// Called for each warning after it is printed: at once, or when the waiting software resumes.
  /// May be null.
  using WarningListener = std::function<void(const Warning&)>;
  void on_warning(WarningListener listener) { warning_listener_ = std::move(listener); }
  /// Warnings throw too: for tests, in which nothing may be warned of.
  void set_fail_on_warning(bool fail) { fail_on_warning_ = fail; }

  std::uint64_t count(sc_core::sc_severity severity) const { return by_severity_[severity]; }
  std::uint64_t count(const std::string& id) const;
  /// Reports of each id so far, info included.
  const std::map<std::string, std::uint64_t>& counts() const { return by_id_; }
  /// The first kept_limit warnings, in order.
  const std::vector<Warning>& warnings() const { return warnings_; }

 private:
  static void handle(const sc_core::sc_report& report, const sc_core::sc_actions& actions);
  void route(const sc_core::sc_report& report);
  struct Line {
    sc_core::sc_severity severity;
    Warning report;
    bool wants_place, prints;
    bool is_last;  ///< that is printed for its id
  };
  void give(const Line& line, const std::string& place);
  static void print_waiting_lines();
  void print_waiting_lines(const std::string& place);

  std::shared_ptr<spdlog::logger> logger_;
  std::function<std::uint64_t()> now_ps_;
  PlaceSource place_;
  std::vector<Line> waiting_;  ///< for the software to say where it is
  static inline bool lines_wait_ = false;
  WarningListener warning_listener_;
  bool fail_on_warning_ = false;
  std::array<std::uint64_t, sc_core::SC_MAX_SEVERITY> by_severity_{};
  std::map<std::string, std::uint64_t> by_id_;
  std::vector<Warning> warnings_;

  ReportRouter* outer_;
  sc_core::sc_report_handler_proc old_handler_;
  std::array<sc_core::sc_actions, sc_core::SC_MAX_SEVERITY> old_actions_{};
  int old_verbosity_;
};

}  // namespace vp
