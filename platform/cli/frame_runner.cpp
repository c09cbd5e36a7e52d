#include <cli/frame_runner.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include <cli/application.h>
#include <host/process.h>
#include <result/console.h>
#include <vp/error.h>

namespace platform::cli {

FrameRunner::FrameRunner(facts::InputSource& source) : source_(source), first_(source.next()) {}

void FrameRunner::run(Simulation& simulation, const Outputs& outputs) {
  const std::optional<std::uint64_t> total = source_.size();
  if (outputs.progress && total && *total > 1) {
    progress_ = std::make_unique<vp::Progress>(simulation.work().many(), *total);
  }
  try {
    simulation.run([this] { return give(); },
                   [&](facts::UnitReport&& report) { return take(report, outputs); });
  } catch (...) {
    // An error of our own, below, came first and is the cause.
    if (!error_) error_ = std::current_exception();
  }
  progress_.reset();
}

facts::SharedInput FrameRunner::give() {
  if (error_ || host::InterruptGuard::noted()) return nullptr;
  try {
    return first_ ? std::move(first_) : source_.next();
  } catch (...) {
    error_ = std::current_exception();
    return nullptr;
  }
}

bool FrameRunner::take(const facts::UnitReport& report, const Outputs& outputs) {
  if (error_) return false;
  try {
    write(report, outputs);
  } catch (...) {
    error_ = std::current_exception();
  }
  return !error_;
}

void FrameRunner::write(const facts::UnitReport& report, const Outputs& outputs) {
  const Application& own = application();
  if (outputs.pictures && own.draw && own.draw(report, *outputs.pictures)) ++pictures_;
  if (outputs.page && own.page_view) outputs.page->add(report.index, own.page_view(report));
  outputs.result.add(report);
  judge(report);
  warnings_ += report.warnings.size();
  ++frames_;
  if (progress_) progress_->update(frames_);
  if (outputs.done) ++*outputs.done;
  if (!outputs.text) return;
  outputs.out << result::frame_text(report, source_.size());
  host::check_written(outputs.out);
}

void FrameRunner::Missing::add(const facts::UnitReport& unit) {
  if (units++ == 0) first = unit.input.empty() ? std::to_string(unit.index + 1) : unit.input;
}

FrameRunner::Missing FrameRunner::without(const std::string& tally) const {
  const auto known = without_.find(tally);
  return known == without_.end() ? Missing{} : known->second;
}

void FrameRunner::judge(const facts::UnitReport& report) {
  if (!report.fulfilled()) unfulfilled_.add(report);
  for (const Requirement& requirement : application().requirements) {
    const auto& held = report.tallies;
    if (std::find(held.begin(), held.end(), requirement.tally) == held.end())
      without_[requirement.tally].add(report);
  }
  const std::optional<std::string> misfit = report.extra ? report.extra->misfit() : std::nullopt;
  if (!misfit) return;
  if (misfit->empty()) fits_ = true;
  if (misfit_.empty() && !misfit->empty()) misfit_ = report.input + ": " + *misfit;
}

}  // namespace platform::cli
