#include <chip/watch/stop_point.h>

#include <utility>

#include <vp/unit.h>

namespace platform {

/// Of the processors: a DMA's bursts do not come from the program.
class StopPoint::Accesses : public BusWatch {
 public:
  explicit Accesses(StopPoint& point) : BusWatch(point.zynq_), point_(point) {
    const std::uint32_t address = names().address_of(point.options_.address);
    watch_only({{address, address}});
  }

 private:
  void note(const BusAccess& access) override {
    if (!access.by_processor || (point_.options_.writes_only && access.read)) return;
    for (const ps::Cpu* core : point_.zynq_.ps.cpus()) {
      if (access.initiator != core->basename()) continue;
      point_.count(" of " + point_.options_.address + ": " + (access.read ? "read " : "write ") +
                       access.value() + " " + access.answer(),
                   *core);
    }
  }

  StopPoint& point_;
};

StopPoint::StopPoint(const StopOptions& options, Zynq& zynq, vp::ReportRouter& reports,
                     Listener listener)
    : options_(options), zynq_(zynq), reports_(reports), listener_(std::move(listener)) {
  ps::Cpu& cpu = zynq_.ps.cpu;
  switch (options_.when) {
    case StopOptions::When::at_time:
      cpu.call_at(options_.ps, [this, &cpu] { meet("the time has come" + cpu.where()); });
      break;
    case StopOptions::When::access:
      accesses_ = std::make_unique<Accesses>(*this);
      break;
    case StopOptions::When::warning:
      reports_.on_warning([this, &cpu](const vp::Warning& w) {
        const bool waited = w.time_ps != zynq_.scheduler.now_ps();
        count(": " + w.where + ": " + w.message + " (" + w.id +
                  (waited ? ", at " + vp::format_time(w.time_ps) : "") + ")",
              cpu);
      });
      break;
    case StopOptions::When::failure:
      for (ps::Cpu* core : zynq_.ps.cpus())
        core->on_failure([this](const std::string& problem) {
          if (!met_) meet(problem);
        });
      break;
  }
}

StopPoint::~StopPoint() {
  reports_.on_warning(nullptr);
}

void StopPoint::count(const std::string& what, const ps::Cpu& cpu) {
  if (++counted_ < options_.number) return;
  const char* const kind = options_.when == StopOptions::When::warning ? "warning " : "access ";
  meet(kind + std::to_string(counted_) + what + cpu.where());
}

void StopPoint::meet(const std::string& what) {
  met_ = true;
  listener_(what);
}

std::string StopPoint::missed() const {
  if (met_) return {};
  const std::string end = vp::format_time(zynq_.scheduler.now_ps());
  const std::string counted = std::to_string(counted_);
  switch (options_.when) {
    case StopOptions::When::at_time:
      return "the run ended at " + end + ", before " + vp::format_time(options_.ps) +
             ": choose an earlier --at";
    case StopOptions::When::access:
      return "the program made " + counted + (options_.writes_only ? " writes" : " accesses") +
             " of " + options_.address + " until the end at " + end + ", not " +
             std::to_string(options_.number) + ": choose a smaller --access, or another --register";
    case StopOptions::When::warning:
      return "there were " + counted + " warnings until the end at " + end + ", not " +
             std::to_string(options_.number) +
             ": choose a smaller --warning; those of the run as a whole have no place in it";
    case StopOptions::When::failure:
      break;
  }
  return "the program was not stopped, but ended at " + end +
         ": choose a moment with --at, --register or --warning";
}

}  // namespace platform
