#include <cli/rtl_bench.h>

#include <pl/axi_image_store/axi_image_store.h>
#include <pl/axi_threshold_bridge/axi_threshold_bridge.h>
#include <pl/blob_detection/blob_detection.h>
#include <pl/blob_labelling/blob_labelling.h>
#include <pl/blob_stream/blob_stream.h>
#include <pl/camera/camera.h>
#include <pl/clock_crossing/clock_crossing.h>
#include <pl/common/pin_stimuli.h>
#include <pl/common/rtl_model.h>
#include <pl/control_crossing/control_crossing.h>
#include <pl/corner_detection/corner_detection.h>
#include <pl/feature_packaging/clocked.h>
#include <pl/frame_status/frame_status.h>
#include <pl/global_threshold/global_threshold.h>
#include <pl/local_threshold/local_threshold.h>
#include <pl/otsu_threshold/otsu_threshold.h>
#include <pl/pixel_stream/pixel_stream.h>
#include <pl/sensor_input/sensor_input.h>
#include <pl/stream_crossing/stream_crossing.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/foreign_object.h>
#include <vp/report.h>
#include <vp/trace.h>
#include <vp/unit.h>
#include <xilinx/bram/bram.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>
#include <string_view>

namespace platform::cli {

namespace {

/// Edges of the first clock that a play lasts: some seconds.
constexpr std::uint64_t played_clocks = 3'000'000;
/// Of an IP between two clocks; that of most others has no meaning.
constexpr std::uint64_t clock_hz = 71'000'000, other_clock_hz = 100'000'000;
/// A reset of a stream crossing reaches both of its sides.
constexpr std::uint32_t longest_crossing = 64;

/// Behind what a proof found, which is the last that matters.
constexpr std::uint64_t clocks_behind = 4;

/// Before a difference.
constexpr std::uint64_t traced_ps = 20'000'000;

/// RTL and model differ.
class Difference : public vp::ProtocolError {
 public:
  using ProtocolError::ProtocolError;
};

struct Module : sc_core::sc_module {
  explicit Module(sc_core::sc_module_name name) : sc_module(name) {}
};

vp::Configuration configuration_of(const PinPlay& play) {
  vp::Configuration configuration;
  for (const vp::ParameterDescription& parameter : play.parameters) {
    if (parameter.path.rfind("pl." + play.instance + ".", 0) == 0)
      configuration.set(parameter.path, parameter.value);
  }
  return configuration;
}

class Bench {
 public:
  Bench(const PinPlay& play, std::ostream& err)
      : play_(play), configuration_(configuration_of(play)) {
    reports_.redirect(err);
    reports_.set_time_source([this] { return scheduler_.now_ps(); });
    scheduler_.set_batch(true);
  }

  /// The IP in lock-step; what drives its pins is to be connected next.
  template <class Ip>
  Ip& stand(const pl::Models<Ip>& models, const pl::Site& site) {
    const vp::HierarchyScope inside(pl_);
    std::shared_ptr<Ip> ip = models.make_rtl(
        play_.instance.c_str(), site, {play_.object, pl::RtlFile::Use::lockstep, play_.seed});
    ip_ = ip;
    ports_ = &dynamic_cast<const pl::ShownPorts&>(*ip).ports();
    return *ip;
  }
  template <class Ip>
  Ip& stand(const pl::Models<Ip>& models) {
    return stand(models, {clk_, play_.geometry});
  }
  /// A link, the other end of which the stimuli drive.
  vp::AxiStream& link(const char* name) {
    links_.push_back(std::make_unique<vp::AxiStream>(name));
    return *links_.back();
  }
  xilinx::Bram& bram() {
    const vp::HierarchyScope inside(pl_);
    bram_ = std::make_unique<xilinx::Bram>("bram", play_.geometry.pixels() / 4);
    bram_->load(play_.pictures.front());
    return *bram_;
  }
  vp::Signal<bool>& other_signal(const char* name) {
    const vp::HierarchyScope inside(play_.recorded ? driver_ : other_driver_);
    signals_.push_back(std::make_unique<vp::Signal<bool>>(name));
    auto& signal = static_cast<vp::Signal<bool>&>(*signals_.back());
    others_[name] = &signal;
    return signal;
  }

  /// All ports that are not bound get a signal; then come the stimuli.
  void bind() {
    for (const pl::IpPorts::Input& input : ports_->inputs) {
      if (input.bind == nullptr) continue;
      pl::PinDriver& driver = driver_of(input);
      if (input.port->signal() == nullptr) {
        const vp::HierarchyScope inside(driver);
        signals_.push_back(input.bind());
      }
      input.port->signal()->set_writer(driver);
    }
    if (play_.recorded)
      driver_.add(std::make_unique<pl::Recorded>(recorded_pins(), play_.recorded->rows));
    else
      driver_.add(std::make_unique<pl::MoodSwings>(mood_, play_.geometry.clocks()));
  }
  template <class Stimulus, class... Arguments>
  void drive(Arguments&&... arguments) {
    if (play_.recorded) return;
    driver_.add(std::make_unique<Stimulus>(mood_, *ports_, std::forward<Arguments>(arguments)...));
  }
  /// On the edges of the other clock.
  template <class Stimulus, class... Arguments>
  void drive_other(Arguments&&... arguments) {
    if (play_.recorded) return;
    other_driver_.add(
        std::make_unique<Stimulus>(mood_, *ports_, std::forward<Arguments>(arguments)...));
  }
  void drive_other(std::unique_ptr<pl::Stimulus> stimulus) {
    if (!play_.recorded) other_driver_.add(std::move(stimulus));
  }
  void resets(const std::string& system = "", std::uint32_t shortest = 1) {
    drive<pl::Resets>("rst", system, shortest);
  }
  void frames(pl::Raster::Rules rules) {
    drive<pl::Raster>(play_.geometry, std::move(rules), play_.pictures);
  }
  void levels(std::initializer_list<const char*> names, std::uint32_t shortest = 1) {
    for (const char* name : names) drive<pl::Levels>(name, shortest);
  }

  /// The whole play; throws for what ended it. `traced_from_ps`: from then on there is a trace.
  void run(std::optional<std::uint64_t> traced_from_ps);
  std::uint64_t now_ps() const { return scheduler_.now_ps(); }

  const pl::Geometry& geometry() const { return play_.geometry; }
  const PinPlay& play() const { return play_; }
  const pl::IpPorts& ports() const { return *ports_; }
  pl::StimulusMood& mood() { return mood_; }
  vp::Clock& clk() { return clk_; }
  vp::Clock& other_clk() { return other_clk_; }

 private:
  pl::PinDriver& driver_of(const pl::IpPorts::Input& input) {
    const vp::Clocked* owner = input.port->owner();
    return owner != nullptr && &owner->clock() == &other_clk_ ? other_driver_ : driver_;
  }

  std::vector<pl::Recorded::Set> recorded_pins();
  void check_fits(const std::string& name, unsigned bits, std::size_t column) const;
  std::uint64_t clocks() const {
    return play_.recorded ? play_.recorded->rows.size() + clocks_behind : played_clocks;
  }

  const PinPlay& play_;
  vp::ReportRouter reports_{sc_core::SC_NONE};
  vp::Configuration configuration_;
  const vp::Configuration::Scope scope_{configuration_};
  vp::ClockScheduler scheduler_{"scheduler"};
  vp::Clock clk_{"clk", scheduler_, clock_hz}, other_clk_{"m_clk", scheduler_, other_clock_hz};
  Module pl_{"pl"};
  pl::StimulusMood mood_;
  pl::PinDriver driver_{"driver", clk_}, other_driver_{"other_driver", other_clk_};
  std::vector<std::unique_ptr<vp::SignalBase>> signals_;
  std::map<std::string, vp::Signal<bool>*> others_;  ///< by the name of the pin that they drive
  std::vector<std::unique_ptr<vp::AxiStream>> links_;
  std::unique_ptr<xilinx::Bram> bram_;
  std::shared_ptr<void> ip_;
  const pl::IpPorts* ports_ = nullptr;
};

/// Throws vp::InputError if a recorded value of input number `column` is wider than its pin.
void Bench::check_fits(const std::string& name, unsigned bits, std::size_t column) const {
  const auto& rows = play_.recorded->rows;
  for (std::size_t i = 0; bits < 64 && i < rows.size(); ++i) {
    if (rows[i][column] >> bits != 0)
      throw vp::InputError("--stimulus, line " + std::to_string(i + 2) + ": '" + name + "' has " +
                           std::to_string(bits) + " bits");
  }
}

std::vector<pl::Recorded::Set> Bench::recorded_pins() {
  std::vector<pl::Recorded::Set> pins;
  for (const std::string& name : play_.recorded->names) {
    const auto other = others_.find(name);
    if (other != others_.end()) {
      pins.emplace_back([signal = other->second](std::uint64_t value) { *signal = value != 0; });
      continue;
    }
    const auto& inputs = ports_->inputs;
    const auto input = std::find_if(inputs.begin(), inputs.end(),
                                    [&](const auto& each) { return each.name == name; });
    if (input == inputs.end() || input->write == nullptr) {
      throw vp::InputError("--stimulus: '" + name + "' of " + play_.instance +
                           (input == inputs.end() ? " is no input" : " is a pin of a sensor") +
                           ": it cannot be played");
    }
    check_fits(name, input->bits, pins.size());
    pins.push_back(input->write);
  }
  return pins;
}

void Bench::run(std::optional<std::uint64_t> traced_from_ps) {
  std::unique_ptr<vp::Tracer> tracer;
  if (traced_from_ps) {
    vp::TraceOptions options;
    options.file = play_.trace_file;
    options.level = vp::TraceLevel::registers;
    options.from_ps = *traced_from_ps;
    tracer = std::make_unique<vp::Tracer>("tracer", scheduler_, options);
  }
  std::exception_ptr error;
  try {
    vp::call_objects([this] {
      sc_core::sc_start(vp::from_ps(clk_.duration_ps(static_cast<double>(clocks()))));
      sc_core::sc_stop();
    });
  } catch (const sc_core::sc_report& report) {  // of a model: vp::error()
    const bool differs = report.get_msg_type() == std::string_view("/markervp/rtl/lockstep");
    error = differs ? std::make_exception_ptr(Difference(report.get_msg()))
                    : std::make_exception_ptr(vp::ProtocolError(report.get_msg()));
  } catch (...) {
    error = std::current_exception();
  }
  if (tracer) tracer->close();
  if (error) std::rethrow_exception(error);
}

// ---- The wires of each IP

void play_corners(Bench& bench) {
  bench.stand(pl::CornerDetection::models());
  bench.bind();
  bench.resets();
  bench.frames({"ena", "x", "y"});
}

void play_blobs(Bench& bench) {
  bench.stand(pl::BlobDetection::models());
  bench.bind();
  bench.resets();
  bench.frames({"ena", "x", "y"});
}

void play_threshold(Bench& bench, const pl::Models<pl::GlobalThreshold>& models,
                    pl::Raster::Rules rules) {
  bench.stand(models);
  bench.bind();
  bench.resets("por");
  bench.frames(std::move(rules));
  bench.levels({"threshold", "wr_thresh"});
}

// The next frame comes when the lagging one has left.
void play_local_threshold(Bench& bench) {
  const auto& parameters = bench.play().parameters;
  const auto radius = std::find_if(parameters.begin(), parameters.end(),
                                   [](const vp::ParameterDescription& parameter) {
                                     return parameter.path == "pl.local_threshold.radius";
                                   });
  const auto rows = static_cast<std::uint32_t>(std::stoul(radius->value)) + 1;
  play_threshold(bench, pl::LocalThreshold::models(),
                 {"frame_ena", "x", "y", true, rows * bench.geometry().clocks_per_row() + 16});
}

// A frame begins when the runs of the last one have been looked at.
void play_labelling(Bench& bench) {
  pl::BlobLabelling& ip = bench.stand(pl::BlobLabelling::models());
  bench.bind();
  bench.resets();
  pl::Raster::Rules rules{"ena", "x", "y", true, bench.geometry().width + 2};
  if (bench.geometry().pixels_per_clock > 1) rules.may_begin = [&ip] { return ip.idle.get(); };
  bench.frames(rules);
}

void play_pixel_stream(Bench& bench) {
  pl::PixelStream& ip = bench.stand(pl::PixelStream::models());
  ip.m(bench.link("m"));
  bench.bind();
  bench.resets();
  bench.frames({"ena", "", ""});
  bench.drive<pl::Readiness>("m_tready");
}

void play_blob_stream(Bench& bench) {
  pl::BlobStream& ip = bench.stand(pl::BlobStream::models());
  ip.m(bench.link("m"));
  bench.bind();
  bench.resets();
  bench.drive<pl::BlobFrames>();
  bench.drive<pl::Readiness>("m_tready");
}

void play_frame_status(Bench& bench) {
  bench.stand(pl::FrameStatus::models());
  bench.bind();
  bench.resets();
  bench.levels({"frame_ena", "idle", "corner_out", "blob_out"});
}

void play_packaging(Bench& bench) {
  bench.stand(pl::FeaturePackaging::models());
  bench.bind();
  bench.resets();
  bench.levels({"ena", "ready", "done"});
  bench.drive<pl::Toggles>("corner_in", "corner_seen", std::vector<std::string>{"corner_data"});
  bench.drive<pl::Toggles>("blob_in", "blob_seen",
                           std::vector<std::string>{"blob_start", "blob_end"});
}

void play_bridge(Bench& bench) {
  pl::AxiThresholdBridge& ip = bench.stand(pl::AxiThresholdBridge::models());
  ip.m(bench.link("m"));
  bench.bind();
  bench.resets();
  bench.levels({"ena"});
  bench.drive<pl::Toggles>("thresh_in", "thresh_seen", std::vector<std::string>{"thresh_data"});
  bench.drive<pl::Readiness>("m_tready");
}

void play_store(Bench& bench) {
  pl::AxiImageStore& ip = bench.stand(pl::AxiImageStore::models());
  ip.bram(bench.bram());
  ip.m(bench.link("m"));
  bench.bind();
  bench.resets();
  bench.levels({"ena"});
  bench.drive<pl::Packets>("m", false);
}

void play_sensor(Bench& bench) {
  pl::SensorInput& ip = bench.stand(pl::SensorInput::models());
  ip.bram(bench.bram());
  bench.bind();
  bench.resets();
  bench.levels({"ena"});
}

void play_camera(Bench& bench) {
  pl::Camera& ip = bench.stand(pl::Camera::models());
  ip.show(bench.play().pictures.front());
  bench.bind();
  bench.resets("por");
  bench.levels({"hold"});
  bench.drive<pl::Levels>("ena", 1u, [&ip, &bench] {
    const auto& pictures = bench.play().pictures;
    ip.show(pictures[bench.mood().random.below(static_cast<std::uint32_t>(pictures.size()))]);
  });
}

void play_control(Bench& bench) {
  bench.stand(pl::ControlCrossing::models());
  bench.bind();
  bench.levels({"ena_in", "rst_in", "por_in", "wr_thresh_in", "threshold_in"});
}

/// The side of the system clock: samples a toggle on each of its edges, or not for a while.
class Seen final : public pl::Stimulus {
 public:
  Seen(pl::StimulusMood& mood, const vp::In<bool>& rst, pl::CrossingRegister& crossing,
       vp::Signal<bool>& seen)
      : mood_(mood), rst_(rst), crossing_(crossing), seen_(seen) {}

 private:
  void edge() override {
    if (rst_.read()) {
      seen_ = false;
    } else if (left_ > 0) {
      --left_;
    } else {
      seen_ = crossing_.toggle.get();
      if (mood_.random.one_in(50)) left_ = mood_.random.magnitude(40);
    }
  }

  pl::StimulusMood& mood_;
  const vp::In<bool>& rst_;
  pl::CrossingRegister& crossing_;
  vp::Signal<bool>& seen_;
  std::uint32_t left_ = 0;
};

void play_clock_crossing(Bench& bench) {
  pl::ClockCrossing& ip = bench.stand(pl::ClockCrossing::models());
  ip.cross_to(bench.other_clk());
  for (const auto& [crossing, name] :
       {std::pair(&ip.corner, "corner_seen"), std::pair(&ip.blob, "blob_seen"),
        std::pair(&ip.binary, "binary_seen")}) {
    vp::Signal<bool>& seen = bench.other_signal(name);
    crossing->set_seen(seen);
    bench.drive_other(std::make_unique<Seen>(bench.mood(), ip.rst, *crossing, seen));
  }
  bench.bind();
  bench.resets();
  bench.drive<pl::Pulses>("corner_out", std::vector<std::string>{"corner_data"});
  bench.drive<pl::Pulses>("blob_out", std::vector<std::string>{"blob_start", "blob_end"});
  bench.drive<pl::Pulses>("thresh_out", std::vector<std::string>{"thresh_data"});
}

void play_stream_crossing(Bench& bench) {
  pl::StreamCrossing& ip = bench.stand(pl::StreamCrossing::models(),
                                       {bench.clk(), bench.geometry(), &bench.other_clk()});
  ip.entry().s(bench.link("s"));
  ip.m(bench.link("m"));
  bench.bind();
  bench.resets("", longest_crossing);
  bench.drive<pl::Packets>("s", true);
  bench.drive_other<pl::Readiness>("m_tready");
}

const std::map<std::string, std::function<void(Bench&)>>& benches() {
  static const std::map<std::string, std::function<void(Bench&)>> all{
      {"axi_image_store", play_store},
      {"axi_threshold_bridge", play_bridge},
      {"blob_crossing", play_stream_crossing},
      {"blob_detection", play_blobs},
      {"blob_labelling", play_labelling},
      {"blob_stream", play_blob_stream},
      {"camera", play_camera},
      {"clock_crossing", play_clock_crossing},
      {"control_crossing", play_control},
      {"corner_detection", play_corners},
      {"feature_packaging", play_packaging},
      {"frame_status", play_frame_status},
      {"global_threshold",
       [](Bench& bench) {
         play_threshold(bench, pl::GlobalThreshold::models(), {"frame_ena", "x", "y"});
       }},
      {"local_threshold", play_local_threshold},
      {"otsu_threshold",
       [](Bench& bench) {
         play_threshold(bench, pl::OtsuThreshold::models(), {"frame_ena", "x", "y"});
       }},
      {"pixel_crossing", play_stream_crossing},
      {"pixel_stream", play_pixel_stream},
      {"sensor_input", play_sensor},
  };
  return all;
}

}  // namespace

bool has_bench(const std::string& instance) {
  return benches().count(instance) != 0;
}

void play_pins(const PinPlay& play, std::ostream& err) {
  const auto played = [&](std::optional<std::uint64_t> traced_from_ps, std::ostream& told) {
    vp::begin_fresh_context();
    Bench bench(play, told);
    benches().at(play.instance)(bench);
    try {
      bench.run(traced_from_ps);
    } catch (const Difference& error) {
      return std::pair(bench.now_ps(), std::string(error.what()));
    }
    return std::pair(std::uint64_t{0}, std::string());
  };
  const auto [ended_ps, problem] = played({}, err);
  if (problem.empty()) return;
  // Once more, with a trace of what came before: a trace of all of it would take far longer.
  std::ostringstream told_already;
  played(ended_ps - std::min(ended_ps, traced_ps), told_already);
  throw vp::ProtocolError(problem);
}

}  // namespace platform::cli
