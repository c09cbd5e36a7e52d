#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <chip/fault/injector.h>
#include <vp/random.h>

namespace platform {

/// All faults that a campaign may draw from: the places of what is built, by class.
///
///   | Class    | Faults                                                                       |
///   |----------|------------------------------------------------------------------------------|
///   | bus      | SLVERR, DECERR, a wrong bit of the next access on a link that was used       |
///   | register | a bit of a register of a device in the logic                                 |
///   | memory   | a bit of a memory in the logic                                               |
///   | buffer   | a bit of a DMA buffer in the DDR                                             |
///   | internal | a bit of a register inside of the logic, where the fidelity has them         |
///   | signal   | a wire of one bit: stuck for 100 us, a rising edge lost or late, a pulse     |
///   | stream   | a beat is dropped, comes twice, has a wrong bit or the other TLAST           |
///   | clock    | a clock of the logic stops, or runs at half its frequency                    |
///   | input    | a dead or hot byte from then on, an input of zeros or ones, a torn one       |
class FaultSpace {
 public:
  static const std::vector<std::string>& classes();
  /// Streams pass single beats then, which takes longer: only if the user asks for it.
  static constexpr const char* on_request = "stream";

  /// After a run of the same platform without faults, whose counters say which links were used.
  /// `chosen`: classes, none for all; `below`: paths, none for all. `units`: inputs of the run.
  /// Throws vp::InputError for a class without a place.
  FaultSpace(Injector& injector, const std::vector<std::string>& chosen,
             const std::vector<std::string>& below, std::uint64_t units);

  /// A fault, and what it belongs to.
  struct Drawn {
    Fault fault;
    std::string of_class;
    std::string module;  ///< path of the place, without its last part
  };
  /// One at a time in [from_ps, to_ps), or of an input when it is given: each class is as likely,
  /// and each bit of a class.
  Drawn draw(vp::RandomBits& random, std::uint64_t from_ps, std::uint64_t to_ps) const;

 private:
  /// A place, and how many faults it has.
  struct Place {
    std::string module;
    std::uint64_t faults;
    /// "what: flip, where: …": fault number `n` of the place, without its time.
    std::function<std::string(std::uint64_t n)> text;
  };
  struct Class {
    std::string name;
    std::vector<Place> places;
    std::uint64_t faults = 0;
  };

  void add(Class& to, const std::string& path, std::uint64_t faults,
           std::function<std::string(std::uint64_t)> text) const;
  Class find(const std::string& name, Injector& injector, std::uint64_t units) const;
  void find_on_buses(Class& found) const;
  void find_registers(Class& found, Zynq& zynq) const;
  void find_memories(Class& found, Zynq& zynq) const;
  void find_buffers(Class& found, Zynq& zynq) const;
  void find_internals(Class& found, Injector& injector) const;
  void find_streams(Class& found, Zynq& zynq) const;
  void find_signals(Class& found, Injector& injector) const;
  void find_clocks(Class& found, Zynq& zynq) const;
  void find_inputs(Class& found, Zynq& zynq, std::uint64_t units) const;

  Injector& injector_;
  std::vector<std::string> below_;
  std::vector<Class> classes_;
};

}  // namespace platform
