#include <chip/run/frame_bench.h>

#include <chip/system/hardware_map.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/unit.h>
#include <algorithm>
#include <cstring>
#include <utility>

namespace platform {

FrameBench::FrameBench(Zynq& zynq, const CameraTiming& camera, const SoftwareOptions& options,
                       const vp::ReportRouter& reports)
    : zynq_(zynq),
      cache_contract_(zynq),
      camera_(camera),
      options_(options),
      reports_(reports),
      takes_input_(zynq.design().input().bytes > 0),
      work_(zynq.design().work()) {
  if (!takes_input_) return;
  const std::size_t bytes = zynq_.design().input().bytes;
  const auto address = zynq_.ps.ddr.dma_memory().allocate(bytes, 4096);
  if (!address) throw vp::InputError("ps.ddr.size leaves no memory for an input");
  frame_.bus_address = *address;
  frame_.pixels = zynq_.ps.ddr.at(*address, bytes);
}

void FrameBench::start(FrameBegins begins, NextFrame next, FrameDone done) {
  begins_ = std::move(begins);
  next_ = std::move(next);
  done_ = std::move(done);
}

// The input after the last one that the program took at the earliest; it was busy since then. One
// that settles is given again.
std::uint64_t FrameBench::next_frame_ps(std::uint64_t now_ps) {
  if (!camera_.has_rate()) return now_ps;
  if (!first_ps_) {
    first_ps_ = period_from_ps_ = now_ps;
    return now_ps;
  }
  const std::uint64_t after = awaited_ + 1;
  const bool settles = showings_left_ > 0;
  if (!settles) busy_ps_.add(static_cast<double>(now_ps - came_ps(awaited_)));
  awaited_ = std::max(after, camera_.first_after(now_ps - *first_ps_));
  missed_ = settles ? 0 : awaited_ - after;
  dropped_ += missed_;
  return came_ps(awaited_);
}

const hal_frame* FrameBench::next_frame(std::uint64_t) {
  if (waiting_ && camera_.has_rate()) {
    waiting_->camera_missed = missed_;
    hand_over(came_ps(awaited_));
  }
  begins_();
  if (showings_left_ == 0 && !take_input()) return nullptr;
  --showings_left_;
  place(input_);
  return &frame_;
}

facts::SharedInput FrameBench::next_input() {
  facts::SharedInput input = stop_ ? nullptr : next_();
  if (input) ++inputs_;
  return input;
}

/// False: there is none.
bool FrameBench::take_input() {
  facts::SharedInput input = next_input();
  for (; input && missed_ > 0; --missed_) input = next_input();
  if (!input) return false;
  const bool settles = input->settles_after(input_.get());
  showings_left_ = 1 + (settles ? zynq_.design().settling_showings() : 0);
  input_ = std::move(input);
  ++taken_;
  return true;
}

std::uint64_t FrameBench::came_ps(std::uint64_t number) const {
  return *first_ps_ + camera_.offset_ps(number);
}

namespace {

/// An input of which the bytes are wrong.
class SpoiledInput : public facts::UnitInput {
 public:
  SpoiledInput(const facts::UnitInput& input, std::vector<std::uint8_t>&& bytes)
      : UnitInput(input.name),
        bytes_(std::move(bytes)),
        width_(input.width()),
        height_(input.height()) {}
  const std::vector<std::uint8_t>& bytes() const override { return bytes_; }
  std::uint32_t width() const override { return width_; }
  std::uint32_t height() const override { return height_; }

 private:
  std::vector<std::uint8_t> bytes_;
  std::uint32_t width_;
  std::uint32_t height_;
};

}  // namespace

// What is wrong with an input is wrong in memory; reports know the right one.
facts::SharedInput FrameBench::spoiled(const facts::SharedInput& input) const {
  if (!spoil_ || !takes_input_) return input;
  std::vector<std::uint8_t> bytes = input->bytes();
  spoil_(taken_, bytes);
  return std::make_shared<SpoiledInput>(*input, std::move(bytes));
}

// Of a program that does not upload its inputs: in the logic.
void FrameBench::place(const facts::SharedInput& right) {
  const facts::SharedInput input = spoiled(right);
  if (!options_.uploads()) zynq_.design().place(input);
  if (takes_input_) {
    const std::vector<std::uint8_t>& bytes = input->bytes();
    std::memcpy(zynq_.ps.ddr.behind(frame_.bus_address, bytes.size()), bytes.data(), bytes.size());
    cache_contract_.placed(frame_.bus_address, bytes.size());
    frame_.width = input->width();
    frame_.height = input->height();
  }
  const bool counts = showings_left_ == 0;
  frame_.index = inputs_ - 1 + settling_showings_;
  if (takes_input_) shown_.push_back({right, frame_.index, inputs_ - 1, counts});
  if (!counts) ++settling_showings_;
  zynq_.design().describe(*right, frame_);
}

namespace {

/// Throws vp::ProtocolError for a figure or a tally that the design did not declare, else gives
/// figures their units.
void check_declared(facts::UnitReport& unit, const facts::Work& work) {
  const auto refuse = [](const std::string& what) {
    throw vp::ProtocolError("the design reports " + what);
  };
  for (auto figure = unit.figures.begin(); figure != unit.figures.end(); ++figure) {
    const auto declared =
        std::find_if(work.figures.begin(), work.figures.end(),
                     [&](const facts::Figure& known) { return known.path == figure->name; });
    if (declared == work.figures.end())
      refuse("figure '" + figure->name + "', which its work() does not declare");
    figure->unit = declared->unit;
    const bool is_twice = std::any_of(unit.figures.begin(), figure, [&](const auto& before) {
      return before.name == figure->name;
    });
    if (is_twice) refuse("figure '" + figure->name + "' twice");
  }
  for (const std::string& name : unit.tallies) {
    const bool is_known =
        std::any_of(work.tallies.begin(), work.tallies.end(),
                    [&](const facts::Tally& tally) { return tally.name == name; });
    if (!is_known) refuse("tally '" + name + "', which its work() does not name");
  }
}

}  // namespace

bool FrameBench::publish(std::uint32_t kind, const void* data, std::size_t size,
                         std::uint64_t now_ps) {
  zynq_.settle();
  facts::UnitReport report;
  if (!zynq_.design().report({kind, data, size, now_ps}, report)) {
    throw vp::ProtocolError(
        "the program published a result of unknown kind or size: build it against the HAL and "
        "the headers of this version" +
        zynq_.ps.cpu.where());
  }
  const Shown shown = published(report.index);
  report.index = shown.index;
  report.given = shown.input;
  if (takes_input_) report.input = shown.input->name;
  zynq_.design().check(report);
  check_declared(report, work_);
  take_new_warnings(report.warnings);
  const bool delivered = report.delivered();
  if (shown.counts) ++published_;
  if (waiting_) hand_over(waiting_->end_ps);
  waiting_ = std::move(report);
  waiting_counts_ = shown.counts;
  if (!camera_.has_rate()) hand_over(std::nullopt);
  return delivered;
}

/// A program may leave out inputs, but not go back or ahead. One that gets none counts what it
/// publishes.
FrameBench::Shown FrameBench::published(std::uint32_t number) {
  if (!takes_input_) return {nullptr, 0, static_cast<std::uint32_t>(published_), true};
  while (!shown_.empty() && shown_.front().number < number) shown_.pop_front();
  if (shown_.empty() || shown_.front().number != number) {
    throw vp::ProtocolError("the program reported frame " + std::to_string(number) +
                            ", which it was not given or reported already" + zynq_.ps.cpu.where());
  }
  Shown shown = std::move(shown_.front());
  shown_.pop_front();
  return shown;
}

/// The period of the frame that waits for it ends at `until_ps`; none: with its result.
void FrameBench::hand_over(std::optional<std::uint64_t> until_ps) {
  if (!waiting_) return;
  if (until_ps) {
    waiting_->camera_period = vp::Interval{period_from_ps_, *until_ps};
    period_from_ps_ = *until_ps;
  }
  facts::UnitReport report = *std::exchange(waiting_, std::nullopt);
  if (!waiting_counts_) return keep_settling(report);
  if (settling_.index == report.index && settling_.settling_showings > 0) {
    report.settling_showings = settling_.settling_showings;
    report.settled_ps = settling_.end_ps;
    report.warnings.insert(report.warnings.begin(), settling_.warnings.begin(),
                           settling_.warnings.end());
  }
  settling_ = {};
  stop_ = !done_(std::move(report)) || stop_;
}

/// Of a showing that does not count: what its frame needs to know.
void FrameBench::keep_settling(const facts::UnitReport& report) {
  if (settling_.index != report.index) settling_ = {};
  settling_.index = report.index;
  settling_.end_ps = report.end_ps;
  ++settling_.settling_showings;
  settling_.warnings.insert(settling_.warnings.end(), report.warnings.begin(),
                            report.warnings.end());
}

std::optional<facts::CameraReport> FrameBench::camera_report() const {
  if (busy_ps_.count() == 0) return std::nullopt;
  return facts::CameraReport{camera_.fps(), busy_ps_.count() + dropped_, dropped_, busy_ps_.mean(),
                             busy_ps_.max()};
}

double FrameBench::option(std::uint32_t option, const hal_option_info&) {
  return options_.value(option);
}

// The program gets what its header would have, had it been written for this configuration.
std::optional<std::uint32_t> FrameBench::xparameter(const char* name) {
  if (!xparameters_) xparameters_ = xparameters_values(zynq_);
  const auto found = xparameters_->find(name);
  if (found == xparameters_->end()) return std::nullopt;
  return found->second;
}

void FrameBench::take_new_warnings(std::vector<std::string>& list) {
  const auto& all = reports_.warnings();
  for (; warnings_reported_ < all.size(); ++warnings_reported_) {
    const vp::Warning& w = all[warnings_reported_];
    list.push_back(w.where + ": " + w.message + " (" + w.id + " at " + vp::format_time(w.time_ps) +
                   ")");
  }
}

std::vector<std::string> FrameBench::finish() {
  if (waiting_) hand_over(waiting_->end_ps);
  cache_contract_.finish();
  zynq_.design().finish();
  std::vector<std::string> list;
  if (settling_.settling_showings > 0) list = std::move(settling_.warnings);
  take_new_warnings(list);
  return list;
}

}  // namespace platform
