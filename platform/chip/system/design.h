#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include <chip/system/processing_system.h>
#include <facts/result.h>
#include <facts/unit.h>
#include <hal/hal.h>
#include <pl/common/fidelity.h>
#include <trace/vocabulary.h>
#include <vp/router.h>
#include <vp/signal.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace platform {

/// What the processing system offers to the programmable logic: clocks, reset, buses, interrupts. A
/// design is wired to these in its constructor.
class PlPorts {
 public:
  /// `otherwise`: how a design is modelled where it does not choose.
  PlPorts(ProcessingSystem& chip, vp::ClockScheduler& clocks, pl::Fidelity otherwise)
      : ps(chip), scheduler(clocks), fidelity(otherwise) {}
  PlPorts(const PlPorts&) = delete;
  PlPorts& operator=(const PlPorts&) = delete;

  /// The rest of the chip, for those who watch the software.
  ProcessingSystem& ps;
  vp::ClockScheduler& scheduler;
  const pl::Fidelity fidelity;

  /// FCLK_CLK`number`, 0 to 3. At coincident edges the one with the lower number samples first.
  vp::Clock& fclk_clk(unsigned number) { return ps.fclk_clk(number).clk; }
  /// FCLK_RESET0_N: low while software holds the PL in reset.
  vp::Signal<bool>& fclk_reset0_n() { return ps.fclk_reset0_n; }
  /// M_AXI_GP0, 0x4000'0000 to 0x7FFF'FFFF: what software reaches is behind `registers`.
  void m_axi_gp0(vp::Router& registers);
  /// M_AXI_GP1, 0x8000'0000 to 0xBFFF'FFFF, on the clock `aclk` of the PL.
  void m_axi_gp1(vp::Router& registers, const vp::Clock& aclk);
  /// S_AXI_HP0: masters behind `memory` reach the DDR.
  void s_axi_hp0(vp::Router& memory);
  /// IRQ_F2P: bits 0 to 7 are interrupts 61 to 68, bits 8 to 15 are 84 to 91.
  void irq_f2p(vp::Signal<std::uint32_t>& lines);

  /// What is behind M_AXI_GP0; null if nothing is.
  const vp::Router* registers() const { return registers_; }
  /// The same of M_AXI_GP1.
  const vp::Router* registers_gp1() const { return registers_gp1_; }

  /// Once the design is built: nothing answers behind a M_AXI_GP0 that it left (DECERR), and
  /// nothing sends to a S_AXI_HP0.
  void tie_off();

 private:
  const vp::Router* registers_ = nullptr;
  const vp::Router* registers_gp1_ = nullptr;
  bool has_memory_master_ = false;
  std::optional<vp::Router> no_registers_;
  std::optional<vp::MmLink> no_memory_master_;
};

/// What a design shows on the timeline of its first units, between software and unit: signals
/// that exist at both fidelities.
struct TimelineEngines {
  /// Works while the signal is high.
  struct Engine {
    std::string name;
    vp::SignalBase* busy;
    bool active_low = false;
    /// Software waits for it in the stage `waiting`.
    bool critical = false;
  };
  /// A channel of a DMA engine, and the line of its interrupt.
  struct Channel {
    std::string name;
    xilinx::DmaChannel* channel;
    std::string interrupt;
    vp::SignalBase* line;
  };
  /// How full a buffer is.
  struct Level {
    std::string name, unit;
    double capacity;
    vp::SignalBase* level;
  };
  /// The most that was in a buffer while a transfer ran: asked when the next one begins.
  struct Peak {
    std::string name, unit;
    double capacity;
    std::size_t channel;
    std::function<double()> most;
  };
  /// Words that are handed over one by one: `enable` rises, each is shown and acknowledged.
  struct Handshake {
    std::string name;
    vp::SignalBase *enable, *word, *acknowledge;
    std::function<std::string(std::uint64_t)> meaning;  ///< what a word says
  };

  std::vector<Engine> engines;
  std::vector<Channel> channels;
  std::vector<Level> levels;
  std::vector<Peak> peaks;
  std::optional<Handshake> handshake;
  std::string waiting;  ///< the stage in which software waits for the logic
};

/// What the program published, and when.
struct Publication {
  std::uint32_t kind;
  const void* data;
  std::size_t size;
  std::uint64_t ps;
};

/// What is in the programmable logic, and how the platform shows it: the module `pl` derives
/// from this, besides. Its parts say themselves what they are as hardware (vp::Ip); memory masters,
/// DMA engines and register devices are found in the hierarchy, too.
class Design {
 public:
  virtual ~Design() = default;

  /// The module.
  sc_core::sc_module& module() { return dynamic_cast<sc_core::sc_module&>(*this); }

  /// What it delivers, and when it has done its job. Must name a job.
  virtual facts::Work work() const = 0;
  /// What the program is given for each unit of work. Default: nothing.
  virtual facts::InputNeed input() const { return {}; }
  /// Says of an input what the program must know beside its bytes and their width and height.
  virtual void describe(const facts::UnitInput& /*input*/, hal_frame& /*frame*/) const {}
  /// Puts an input where it need not be uploaded: into a sensor's memory. Default: nowhere.
  virtual void place(const facts::SharedInput& /*input*/) {}
  /// Brings memories and counters up to now, for observers from outside.
  virtual void settle() {}

  /// The value of a program's option that the logic decides, and no user; in the option's unit.
  virtual std::optional<double> program_option(const std::string& /*name*/) const { return {}; }

  /// A program's option as it is in this run, in the option's unit: each, before the program runs;
  /// and "unoptimised", 1 if it is compiled with -O0 and sw.opt=O2 would be faster.
  virtual void note_option(const std::string& /*name*/, double /*value*/) {}
  /// How often an input that has nothing to do with the one before it must be given until what the
  /// logic learns from it is its own: the units until then do not count.
  virtual std::uint32_t settling_showings() const { return 0; }

  /// Fills in a unit: times, counts, figures, failures, and warnings of what was lost; of a design
  /// that takes inputs also the `index` that the program knows the input by. False: no program of
  /// this design publishes such a thing.
  virtual bool report(const Publication& /*publication*/, facts::UnitReport& /*unit*/) {
    return false;
  }
  /// Looks over a unit whose input is known by now, too.
  virtual void check(facts::UnitReport& /*unit*/) {}
  /// The run is over, perhaps in the middle of a unit: watchers warn of what they still know.
  virtual void finish() {}

  /// High while a unit passes the logic, which works then, where it does not count its work. Null:
  /// it always works.
  virtual vp::Signal<bool>* busy() { return nullptr; }
  /// Makes parameters of its own below `power`, of which it is in the constructor.
  virtual void add_power_options() {}
  /// Whether coefficients without static power (NAME_net of the table) hold for its parts.
  virtual bool has_net_figures() const { return false; }
  /// The groups of its parts, in the order of reports. Groups that are missing follow.
  virtual std::vector<std::string> groups() const { return {}; }
  /// A clock of the PL, as power reports name its root: `pl.clocks.<role>`.
  struct ClockRole {
    std::string role;
    const vp::Clock* clock;
    std::string group;  ///< its power counts there
  };
  /// Default: the clocks of its parts, each in the group of the first one.
  virtual std::vector<ClockRole> clock_roles();

  /// Parts in whose place a stub answered the program so far.
  virtual std::vector<std::string> used_stubs() const { return {}; }

  /// What the timeline shows of the logic.
  virtual TimelineEngines timeline() { return {}; }
};

/// For designs whose signals have no known names.
const trace::Vocabulary& no_words();

/// A kind of design: what is known of it before it is built.
struct DesignInfo {
  std::string name;
  std::string description;  ///< one line
  /// PS programs that belong to it, by name; the first runs if none is asked for. One that is asked
  /// for without a design chooses the design that it belongs to.
  std::vector<std::string> programs;
  bool draws_power = true;  ///< the PL is configured with it
  /// The words of its signals. Default: none are known.
  const trace::Vocabulary& (*words)() = no_words;
  /// Builds it as the module `name`, wired to `ports`, which outlive it.
  std::function<std::unique_ptr<Design>(const char* name, PlPorts& ports)> make;
  /// Parameters of the whole platform that are otherwise with this design unless the user sets
  /// them:
  /// {"power.ddr.width", "16"}.
  std::vector<std::pair<std::string, std::string>> defaults = {};
};

}  // namespace platform
