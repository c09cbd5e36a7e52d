#include <vp/error.h>

#include <vp/report.h>
#include <vp/trace.h>
#include <vp/wave_writer.h>
#include "trace_sources.h"

#include <algorithm>
#include <string>
#include <utility>

namespace vp {

namespace {

constexpr std::uint64_t never = TraceOptions::never;

WaveWriter::Kind kind_of(const TraceSource& source) {
  if (source.text) return WaveWriter::Kind::text;
  if (source.real) return WaveWriter::Kind::real;
  return source.probe ? WaveWriter::Kind::reg : WaveWriter::Kind::wire;
}

}  // namespace

// The hot path: for every change of a traced signal.
inline void Tracer::mark(WaveWriter::Id id, std::uint64_t bits) {
  values_[id] = bits;
  marked_[id / 64] |= std::uint64_t{1} << (id % 64);
}

// A new value of a variable now.
inline void Tracer::record(WaveWriter::Id id, std::uint64_t bits) {
  if (!recording_) return;
  const std::uint64_t now = scheduler_.now_ps();
  if (now != instant_ps_) enter(now);
  if (recording_) mark(id, bits);
}

void Tracer::on_change(SignalBase& signal, std::uint32_t id) {
  record(id, signal.bits());
  // At once: when the instant's changes are written, the next one may have begun.
  if (has_texts_ && texts_[id]) text_values_[id] = texts_[id]->text();
}

Tracer::Tracer(sc_core::sc_module_name name, ClockScheduler& scheduler, TraceOptions options)
    : sc_module(name),
      scheduler_(scheduler),
      options_(std::move(options)),
      probes_(std::make_unique<ProbePoll>()) {
  if (options_.from_ps >= options_.to_ps) {
    throw InputError("the trace window from " + std::to_string(options_.from_ps) + " ps to " +
                     std::to_string(options_.to_ps) + " ps is empty; its end must come later");
  }
  writer_ = open_wave_writer(options_.file);
  if (!options_.trigger) vcd_ = dynamic_cast<VcdWriter*>(writer_.get());
  if (options_.trigger) {
    auto gate = std::make_unique<FrameGate>(std::move(writer_), *options_.trigger);
    gate_ = gate.get();
    writer_ = std::move(gate);
  }
  SC_HAS_PROCESS(Tracer);
  SC_METHOD(open_window);
  sensitive << window_opens_;
  dont_initialize();
  SC_METHOD(leave_window);
  sensitive << window_left_;
  dont_initialize();
}

Tracer::~Tracer() {
  if (!writer_ || !writer_->begun()) return;
  vcd_ = nullptr;
  writer_.reset();
  try {
    warn(*this, "/markervp/trace/incomplete",
         "the run ended before its trace '" + options_.file.string() + "' was closed");
  } catch (...) {  // warnings may be set to throw; a destructor must not
  }
}

bool Tracer::close() {
  if (!writer_) return false;
  const std::uint64_t now = scheduler_.now_ps();
  if (recording_) end_of_instant(now);
  if (recording_) write_falls_before(std::min(now + 1, options_.to_ps));
  recording_ = false;
  leave_window();
  const auto writer = std::move(writer_);
  vcd_ = nullptr;
  const bool has_begun = writer->begun();
  if (started_ && !has_begun) {
    warn(*this, "/markervp/trace/window",
         "no trace '" + options_.file.string() + "': the run ended at " + std::to_string(now) +
             " ps, before its window began at " + std::to_string(options_.from_ps) + " ps");
  }
  writer->close(std::min(now, options_.to_ps));
  const bool wrote = has_begun && (!gate_ || gate_->kept() != 0);
  if (gate_ && has_begun) warn_of_gate();
  gate_ = nullptr;
  return wrote;
}

void Tracer::warn_of_gate() const {
  const std::string file = "'" + options_.file.string() + "'";
  if (gate_->kept() == 0 && options_.trigger->expected) {
    warn(*this, "/markervp/trace/trigger",
         "no trace " + file + ": in no frame '" + options_.trigger->condition.text() +
             "' came true");
  }
  if (gate_->lost_bytes() != 0) {
    warn(*this, "/markervp/trace/trigger",
         "a frame does not fit into the trigger's buffer: the beginnings of frames were given up");
  }
}

// The watchers of the clocks are modules: they must stand before the elaboration ends, when it is
// not known yet which of them will be wanted.
void Tracer::before_end_of_elaboration() {
  if (!options_.clocks) return;
  for (Clock* clock : find_clocks(scheduler_)) {
    clocks_.push_back(
        std::make_unique<TraceClock>(sc_core::sc_gen_unique_name("clock"), *clock, *this));
  }
}

void Tracer::start_of_simulation() {
  select_sources();
  select_clocks();
  started_ = true;  // not before: a filter that selects nothing is an error of its own
  marked_.assign(values_.size() / 64 + 1, 0);
  if (options_.from_ps == 0) {
    open_window();
  } else {
    window_opens_.notify(from_ps(options_.from_ps));
  }
}

void Tracer::select_sources() {
  std::vector<std::string> visible, hidden;
  std::vector<TraceSource> all = find_trace_sources();
  std::vector<std::string> needed;
  if (gate_) {
    for (const TraceSource& source : all) needed.push_back(source.path);
    needed = gate_->needed(needed);
  }
  for (TraceSource& source : all) {
    const bool shown = !source.probe || options_.level != TraceLevel::ports;
    (shown ? visible : hidden).push_back(source.path);
    const bool triggers = std::find(needed.begin(), needed.end(), source.path) != needed.end();
    if (!triggers && (!shown || !options_.filter.selects(source.path))) continue;
    follow(source, writer_->add(source.path, kind_of(source), source.width));
    sources_.push_back(std::move(source));
  }
  options_.filter.check(visible, hidden);
  values_.assign(sources_.size(), 0);
}

void Tracer::follow(const TraceSource& source, WaveWriter::Id id) {
  if (source.probe) probes_->add(*source.probe, id);
  if (source.signal) return;
  sc_core::sc_spawn_options method;
  method.spawn_method();
  method.dont_initialize();
  method.set_sensitivity(source.foreign_event);
  sc_core::sc_spawn([this, id, bits = source.foreign_bits] { record(id, bits()); },
                    sc_core::sc_gen_unique_name("follow"), &method);
}

void Tracer::select_clocks() {
  for (auto& clock : clocks_) {
    clock->selected = std::any_of(sources_.begin(), sources_.end(), [&](const TraceSource& source) {
      const Clocked* writer = source.signal ? source.signal->writer() : nullptr;
      return writer && &writer->clock() == &clock->clock();
    });
    if (!clock->selected) continue;
    clock->id = writer_->add(clock->clock().name(), WaveWriter::Kind::wire, 1);
    values_.push_back(0);
  }
  for (const TraceSource& source : sources_) {
    texts_.push_back(source.text);
    has_texts_ |= source.text != nullptr;
  }
  texts_.resize(values_.size());
  text_values_.resize(values_.size());
}

void Tracer::attach_to(const TraceSource& source, WaveWriter::Id id) {
  if (!source.signal || source.probe) return;
  source.signal->attach(*this, id);
  if (!source.text) return;
  for (SignalBase* followed : source.text->sources()) followed->attach(*this, id);
}

void Tracer::open_window() {
  scheduler_.synchronise();
  instant_ps_ = scheduler_.now_ps();
  for (std::size_t id = 0; id < sources_.size(); ++id) values_[id] = sources_[id].bits();
  for (auto& clock : clocks_) {
    if (!clock->selected) continue;
    std::uint64_t until_ps = never;
    values_[clock->id] = clock->high_at(instant_ps_, until_ps);
    if (values_[clock->id]) fall_later(*clock, until_ps);
    clock->wake();
  }
  writer_->begin(instant_ps_, values_);
  for (std::size_t id = 0; id < sources_.size(); ++id) {
    attach_to(sources_[id], static_cast<WaveWriter::Id>(id));
    if (texts_[id]) writer_->change_text(static_cast<WaveWriter::Id>(id), texts_[id]->text());
  }
  scheduler_.add_observer(*this);
  attached_ = recording_ = true;
}

// Not from on_change() or end_of_instant(): their callers walk the lists that this shortens.
void Tracer::leave_window() {
  if (!attached_) return;
  attached_ = false;
  for (const TraceSource& source : sources_) {
    if (!source.signal || source.probe) continue;
    source.signal->detach(*this);
    if (!source.text) continue;
    for (SignalBase* followed : source.text->sources()) followed->detach(*this);
  }
  scheduler_.remove_observer(*this);
}

void Tracer::stop_recording() {
  recording_ = false;
  scheduler_.notify(window_left_);
  // close() tells why.
  if (writer_->failed() && sc_core::sc_get_status() == sc_core::SC_RUNNING) sc_core::sc_stop();
}

void Tracer::end_of_instant(std::uint64_t ps) {
  if (recording_) enter(ps);
  if (!recording_) return;
  probes_->run(values_, [this](WaveWriter::Id id, std::uint64_t bits) { mark(id, bits); });
  flush();
}

// The marked changes are written when time has moved on, or at the end of the instant: changes by
// processes have no end of instant of their own.
void Tracer::enter(std::uint64_t ps) {
  if (ps == instant_ps_) return;
  flush();
  write_falls_before(std::min(ps, options_.to_ps));
  instant_ps_ = ps;
  if (ps >= options_.to_ps || (vcd_ ? vcd_->failed() : writer_->failed())) {
    stop_recording();
  } else {
    write_falls_at(ps);
  }
}

// In the order of the ids, not of the changes.
void Tracer::flush() {
  if (vcd_) {
    flush_to(*vcd_);
  } else {
    flush_to(*writer_);
  }
}

template <class Writer>
inline void Tracer::flush_to(Writer& writer) {
  for (std::size_t word = 0; word < marked_.size(); ++word) {
    std::uint64_t bits = marked_[word];
    if (bits == 0) continue;
    marked_[word] = 0;
    writer.set_time(instant_ps_);
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t id = word * 64 + static_cast<std::size_t>(__builtin_ctzll(bits));
      const auto writer_id = static_cast<WaveWriter::Id>(id);
      if (!has_texts_ || !texts_[id]) {
        writer.change(writer_id, values_[id]);
      } else {
        writer.change_text(writer_id, text_values_[id]);
      }
    }
  }
}

void Tracer::rise(TraceClock& clock, std::uint64_t ps) {
  enter(ps);
  if (!recording_) return;
  // A clock that became faster while it was high falls just before it rises.
  writer_->set_time(ps - 1);
  writer_->change(clock.id, 0);
  mark(clock.id, 1);
  fall_later(clock, ps + clock.half_period_ps());
}

void Tracer::fall_later(TraceClock& clock, std::uint64_t ps) {
  clock.fall_ps = ps;
  next_fall_ps_ = never;
  for (const auto& each : clocks_) next_fall_ps_ = std::min(next_fall_ps_, each->fall_ps);
}

void Tracer::write_falls_before(std::uint64_t ps) {
  while (next_fall_ps_ < ps) {
    const std::uint64_t fall_ps = next_fall_ps_;
    writer_->set_time(fall_ps);
    for (auto& clock : clocks_) {
      if (clock->fall_ps != fall_ps) continue;
      values_[clock->id] = 0;
      writer_->change(clock->id, 0);
      fall_later(*clock, never);
    }
  }
}

void Tracer::write_falls_at(std::uint64_t ps) {
  if (next_fall_ps_ != ps) return;
  for (auto& clock : clocks_) {
    if (clock->fall_ps != ps) continue;
    mark(clock->id, 0);
    fall_later(*clock, never);
  }
}

namespace {

template <class Visit>
void visit_objects(const std::vector<sc_core::sc_object*>& objects, const Visit& visit) {
  for (sc_core::sc_object* object : objects) {
    visit(*object);
    visit_objects(object->get_child_objects(), visit);
  }
}

template <class T>
bool adopt(sc_core::sc_object& object, TraceSource& source) {
  auto* signal = dynamic_cast<sc_core::sc_signal_in_if<T>*>(&object);
  if (!signal) return false;
  source.width = default_width<T>();
  source.foreign_bits = [signal] { return static_cast<std::uint64_t>(signal->read()); };
  source.foreign_event = &signal->value_changed_event();
  return true;
}

/// The types that Verilator and common models use for pins of up to 64 bits.
bool adopt_foreign(sc_core::sc_object& object, TraceSource& source) {
  return adopt<bool>(object, source) || adopt<std::uint8_t>(object, source) ||
         adopt<std::uint16_t>(object, source) || adopt<std::uint32_t>(object, source) ||
         adopt<std::uint64_t>(object, source) || adopt<std::int32_t>(object, source);
}

}  // namespace

std::vector<TraceSource> find_trace_sources() {
  std::vector<TraceSource> sources;
  visit_objects(sc_core::sc_get_top_level_objects(), [&](sc_core::sc_object& object) {
    TraceSource source;
    source.path = object.name();
    if (auto* signal = dynamic_cast<SignalBase*>(&object)) {
      source.width = signal->width();
      source.real = signal->is_real();
      source.signal = signal;
      source.probe = dynamic_cast<const ProbeBase*>(signal);
      source.text = dynamic_cast<const TextSignal*>(signal);
    } else if (!adopt_foreign(object, source)) {
      return;
    }
    sources.push_back(std::move(source));
  });
  return sources;
}

std::vector<Clock*> find_clocks(const ClockScheduler& scheduler) {
  std::vector<Clock*> clocks;
  visit_objects(sc_core::sc_get_top_level_objects(), [&](sc_core::sc_object& object) {
    auto* clock = dynamic_cast<Clock*>(&object);
    if (clock && &clock->scheduler() == &scheduler) clocks.push_back(clock);
  });
  return clocks;
}

ProbeBase::ProbeBase(const char* name, unsigned width, const void* address, std::size_t byte_count)
    : SignalBase(name), width_(width), address_(address), byte_count_(byte_count) {}

// A probe is never written.
void ProbeBase::commit() {}

}  // namespace vp
