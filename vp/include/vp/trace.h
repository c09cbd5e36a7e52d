#pragma once

#include <vp/clock_scheduler.h>
#include <vp/frame_gate.h>
#include <vp/probe.h>
#include <vp/signal.h>
#include <vp/wave_writer.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

namespace vp {

class ProbePoll;
class TraceClock;
class VcdWriter;
struct TraceSource;

enum class TraceLevel : std::uint8_t {
  ports,       ///< signals
  registers,   ///< and probes: the registers inside
  everything,  ///< and transactions, which the platform makes readable
};

struct TraceOptions {
  static constexpr std::uint64_t never = ~std::uint64_t{0};

  std::filesystem::path file;  ///< .vcd, .vcd.gz or .fst
  TraceFilter filter;
  TraceLevel level = TraceLevel::ports;
  /// Traced is from <= time < to, in ps.
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = never;
  /// Also the clocks of the modules whose signals are traced: event-driven clocks have no wire, so
  /// their waveform is made up (high in the first half of a period, also while the domain sleeps).
  bool clocks = false;
  /// Keeps the frames in which something happens. Its signals are traced whatever the filter says.
  std::optional<FrameTrigger> trigger;
};

/// Writes the signals, probes and clocks of the platform into a VCD or FST.
///
/// Models hold no trace code: when the simulation starts, the tracer walks the object hierarchy and
/// takes what the options select. The names in the file are the names of the objects. Standard
/// sc_signal objects of bool and integers, as foreign modules have them, are traced like signals.
/// What is not selected costs nothing, and nothing costs anything outside the time window. A signal
/// that changes several times in an instant shows its last value.
///
/// A window that starts later than 0 needs a timed event: a run that ends because nothing is left
/// to do ends at the window's start at the earliest.
class Tracer : public sc_core::sc_module, private SignalListener, private InstantObserver {
 public:
  /// Opens the file. Throws InputError if it cannot be written or the window is empty. The start of
  /// the simulation throws InputError if the filter selects nothing.
  Tracer(sc_core::sc_module_name name, ClockScheduler& scheduler, TraceOptions options);
  /// Without close(): what was traced is kept and marked as incomplete, with a warning.
  ~Tracer() override;

  /// Ends the trace and gives the file its name. Call it when the run is over, also after an error
  /// (the trace up to then is a complete file), while the platform still exists. Throws InputError
  /// if the file could not be written; then no file is left. Returns false, with a warning, if
  /// nothing was written: the run ended before the window began, or the trigger never fired.
  bool close();

  /// Signals, probes and clocks in the trace; known when the simulation has started.
  std::size_t size() const { return values_.size(); }

 private:
  friend class TraceClock;

  void before_end_of_elaboration() override;
  void start_of_simulation() override;
  void select_sources();
  void select_clocks();
  void follow(const TraceSource& source, WaveWriter::Id id);
  void attach_to(const TraceSource& source, WaveWriter::Id id);
  void warn_of_gate() const;
  void open_window();
  void leave_window();

  void on_change(SignalBase& signal, std::uint32_t id) override;
  void end_of_instant(std::uint64_t ps) override;
  void record(WaveWriter::Id id, std::uint64_t bits);
  void mark(WaveWriter::Id id, std::uint64_t bits);
  void enter(std::uint64_t ps);
  void flush();
  template <class Writer>
  void flush_to(Writer& writer);
  void rise(TraceClock& clock, std::uint64_t ps);
  void fall_later(TraceClock& clock, std::uint64_t ps);
  void write_falls_before(std::uint64_t ps);
  void write_falls_at(std::uint64_t ps);
  void stop_recording();

  ClockScheduler& scheduler_;
  TraceOptions options_;
  std::unique_ptr<WaveWriter> writer_;
  VcdWriter* vcd_ = nullptr;          ///< the same, where it is one: its calls are inlined
  FrameGate* gate_ = nullptr;         ///< the writer, if there is a trigger
  std::vector<TraceSource> sources_;  ///< the place is the id
  std::vector<std::unique_ptr<TraceClock>> clocks_;
  std::unique_ptr<ProbePoll> probes_;
  sc_core::sc_event window_opens_;
  sc_core::sc_event window_left_;
  bool started_ = false;
  bool recording_ = false;
  bool attached_ = false;
  std::uint64_t instant_ps_ = 0;  ///< to which the marked changes belong
  std::uint64_t next_fall_ps_ = TraceOptions::never;
  std::vector<std::uint64_t> values_;  ///< by id: the newest value
  bool has_texts_ = false;
  std::vector<const TextSignal*> texts_;  ///< by id: of a text; null for numbers
  std::vector<std::string> text_values_;  ///< by id: the newest text
  std::vector<std::uint64_t> marked_;     ///< a bit for each id that changed in this instant
};

}  // namespace vp
