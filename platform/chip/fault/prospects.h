#pragma once

#include <chip/fault/injector.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace platform {

/// What is known of faults before they happen, from a run without faults: that a fault changes
/// nothing, or that it does the same as another one.
///
///   | Fault                  | Changes nothing                            | Does the same as |
///   |------------------------|--------------------------------------------|---------------------------|
///   | slverr, decerr,        | no access follows on the link              | one whose next access
///   is  | | corrupt                |                                            | the same | |
///   lost, late             | no rising edge follows                     | one whose next edge is |
///   |                        |                                            | the same | | stuck,
///   spurious        | the signal has that value all the time     |                           | |
///   flip of a block memory | the byte is written before any byte of the | | | | memory is read, or
///   neither comes           |                           | | input, torn            | | one with
///   the same words   |
///
/// Of all others nothing is known: what the logic does with its registers, and the program with the
/// DDR, is not recorded.
class Prospects {
 public:
  explicit Prospects(Injector& injector);
  ~Prospects();
  Prospects(const Prospects&) = delete;
  Prospects& operator=(const Prospects&) = delete;

  /// One more fault, as FaultSpace draws them; before the run without faults.
  void look_at(const Fault& fault);

  struct Prospect {
    bool changes_nothing = false;
    std::uint64_t times = 0;  ///< of one that changes nothing: how often it happens
    /// Faults with the same text here do the same.
    std::string meets;
  };
  /// In the order of look_at(); after the run.
  std::vector<Prospect> found();

 private:
  class LinkUse;
  class SignalUse;
  class MemoryUse;

  void look_at_accesses(const Fault& fault, Prospect& found);
  void look_at_edges(const Fault& fault, Prospect& found);
  void look_at_level(const Fault& fault, Prospect& found);
  void look_at_byte(const Fault& fault, Prospect& found);
  /// Compares a count of what a fault can meet at its time with that at the end.
  void look_at_count(const Fault& fault, Prospect& found, std::function<std::uint64_t()> count);

  Injector& injector_;
  std::deque<Prospect> found_;
  std::vector<std::function<void()>> at_end_;
  std::map<std::string, std::unique_ptr<LinkUse>> links_;
  std::map<std::string, std::unique_ptr<SignalUse>> signals_;
  std::map<std::string, std::unique_ptr<MemoryUse>> memories_;
};

}  // namespace platform
