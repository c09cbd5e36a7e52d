#pragma once

#include <chip/fault/fault.h>
#include <chip/system/zynq.h>
#include <facts/result.h>
#include <trace/vocabulary.h>
#include <vp/axi_stream.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

namespace platform {

/// Of a register, of a word in memory and on links of 32 bits.
constexpr unsigned word_bits = 32;

/// A fault of a run, and what came of it.
struct Injection {
  Fault fault;
  std::uint64_t times = 0;     ///< how often it happened
  std::uint64_t first_ps = 0;  ///< when it did first

  void happened(std::uint64_t now_ps) {
    if (times++ == 0) first_ps = now_ps;
  }
};

/// Something at a place of the platform that goes wrong there: a bus, a signal.
class FaultyPlace {
 public:
  virtual ~FaultyPlace() = default;
};

/// Lets things go wrong. What it does follows from the faults alone, and is the same at every
/// fidelity that has their places. Without faults it does nothing.
class Injector {
 public:
  /// `words` of the design say which signals a fidelity does not play.
  Injector(Zynq& zynq, const trace::Vocabulary& words) : zynq_(zynq), words_(words) {}
  Injector(const Injector&) = delete;
  Injector& operator=(const Injector&) = delete;

  /// Finds the place of one more fault; before the run, or from an action of plan(). `origin`:
  /// where it was written. Throws vp::InputError for a place that does not exist, with the nearest
  /// name, and for a fault that does not fit its place.
  void add(const Fault& fault, const std::string& origin);

  /// Changes what the program is given as unit `unit`, from 1.
  void spoil(std::uint64_t unit, std::vector<std::uint8_t>& bytes);
  /// Just before the program was given unit `unit` of those that spoil() saw; 0: it was not.
  std::uint64_t before_unit_ps(std::uint64_t unit) const;

  /// What came of the faults, in their order.
  std::vector<facts::Injected> report() const;

  // For the places.
  Zynq& zynq() { return zynq_; }
  /// The key of the configuration that is tlm, so that a signal or register does not move as it
  /// does in hardware, where a fault has another outcome; empty: it does.
  std::string unplayed(const std::string& path) const;
  /// Calls `action` at a time, now or later; those of one time in the order of the calls. Before
  /// the run, or from an action.
  void plan(std::uint64_t at_ps, std::function<void()> action);
  /// From an action: `give_up` at a time, in the place of all that is planned. Programs whose
  /// main() has returned do not wait for it.
  void plan_end(std::uint64_t at_ps, std::function<void()> give_up);
  /// The same for a time that a clock edge finds: `after_ps` from the present instant on.
  void plan_from_edge(std::uint64_t after_ps, std::function<void()> action);

 private:
  void place(Injection& injection);
  void start();
  void run();

  Zynq& zynq_;
  const trace::Vocabulary& words_;
  std::deque<Injection> injections_;
  std::vector<std::unique_ptr<FaultyPlace>> places_;
  std::multimap<std::uint64_t, std::function<void()>> plans_;
  sc_core::sc_event planned_;
  bool started_ = false;
  std::vector<std::uint8_t> before_;     ///< the unit before, as it was made
  std::vector<std::uint64_t> given_ps_;  ///< by unit
};

/// Whether a path is that of a stream.
bool is_stream(const std::string& path);
/// Whether single beats of a stream can be faulty. RTL of the user at an end moves its wires
/// whenever they settle, which does not tell beats apart.
bool counts_beats(const vp::AxiStream& stream);
/// Before the run: each stream passes its beats one by one, so that faults can be added later.
void let_streams_fail();

/// Throws vp::InputError for a signal or register that Injector::unplayed() has a key for.
void check_played(const Injector& injector, const std::string& path);

// One for each group of kinds; they throw vp::InputError as Injector::add() does.
std::unique_ptr<FaultyPlace> place_bus_fault(Injector& injector, Injection& injection);
std::unique_ptr<FaultyPlace> place_stream_fault(Injector& injector, Injection& injection);
std::unique_ptr<FaultyPlace> place_signal_fault(Injector& injector, Injection& injection);
void plan_flip(Injector& injector, Injection& injection);
void plan_clock_fault(Injector& injector, Injection& injection);

}  // namespace platform
