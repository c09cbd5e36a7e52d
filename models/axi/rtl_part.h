#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include <axi/input_checker.h>
#include <axi/interfaces.h>
#include <axi/rtl_links.h>
#include <pl/common/rtl_activity.h>
#include <pl/common/rtl_object.h>
#include <pl/common/rtl_rest.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>

namespace axi {

/// Any RTL as a part of a design: what markervp_add_rtl() built without IP. Its interfaces are
/// found among its ports, and each is connected by the name that interfaces() has for it:
///
///   axi::RtlPart filter{"filter", "build/filter.so", {{"ap_clk", &clk}}};
///   filter.input("ap_rst_n", proc_sys_reset.peripheral_aresetn);
///   bus.map("filter", 0x43C0'0000, 0x1'0000).bind(filter.slave("s_axi_control").socket);
///   memory.connect(filter.master("m_axi_gmem").read, filter.master("m_axi_gmem").write);
///   filter.stream_in("in_r")(dma_to_filter);
///   filter.stream_out("out_r")(filter_to_dma);
///   concat.connect_interrupt(filter.output<bool>("interrupt"), 61);
///   filter.tie("mode", 3);
///
/// Before an edge inputs are sampled, behind it outputs change, as with all our modules; logic from
/// inputs to outputs settles at the end of an instant. RTL at rest sleeps. Its pins are probes for
/// traces. All calls but interfaces() belong to elaboration; they throw vp::InputError, with the
/// place of the port, for what does not go together.
class RtlPart final : public sc_core::sc_module, public vp::Ip, private vp::SignalListener {
 public:
  /// A port that is a clock, and the clock that drives it. Of logic without any clock one without a
  /// port: what its reports are about.
  using ClockPins = std::vector<std::pair<std::string, vp::Clock*>>;

  /// Throws vp::InputError for a file that is no RTL of this kind, for interfaces that cannot be
  /// found (find_interfaces()), and unless `clocks` has each clock of the RTL.
  RtlPart(sc_core::sc_module_name name, const std::string& file, const ClockPins& clocks);
  ~RtlPart() override;
  /// "RTL <top>": what maps call it.
  const char* kind() const override { return kind_.c_str(); }

  const std::vector<Interface>& interfaces() const { return interfaces_; }
  const std::string& file() const { return rtl_->file(); }
  /// What describes its registers: the file that the parameter `registers` names, else
  /// NAME.registers.xml, .rdl or .h beside NAME.so; "" if no such file exists.
  std::string registers_file() const;

  /// A memory-mapped slave: bind its socket to an interconnect.
  TlmToPins& slave(const std::string& name);
  /// A memory-mapped master: connect its ports `read` and `write` to memory.
  PinsToTlm& master(const std::string& name);
  /// Bytes of a beat of a stream; 0: it has no TDATA.
  unsigned stream_bytes(const std::string& name) const;
  /// A stream that the RTL receives. The link must be as wide.
  vp::AxiStreamSlave& stream_in(const std::string& name);
  /// A stream that the RTL sends. Without TLAST `packet_beats` says how many beats a packet has, 0
  /// for streams without packets; RTL with TLAST ignores it.
  vp::AxiStreamMaster& stream_out(const std::string& name, unsigned packet_beats = never_said);
  /// The signal of an output: an interrupt, a wire. T is at least as wide.
  template <class T>
  vp::Signal<T>& output(const std::string& name);
  /// An input follows `signal`: a reset, a wire. Bits that it lacks are 0.
  void input(const std::string& name, vp::SignalBase& signal);
  /// An input that never changes.
  void tie(const std::string& name, std::uint64_t value);
  /// An interface that is not used: its inputs stay 0.
  void leave_open(const std::string& name);

 private:
  static constexpr unsigned never_said = ~0u;
  class Side;
  /// An output port and the signal that follows it.
  struct Output {
    std::string name;
    Pin pin;
    std::unique_ptr<vp::SignalBase> signal;
    std::function<void(std::uint64_t)> write;
    std::uint64_t value = 0;
  };

  void before_end_of_elaboration() override;
  void end_of_elaboration() override;
  void start_of_simulation() override;
  void end_of_simulation() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  vp::IpEstimate own_estimate() const override;

  void connect_clocks(const ClockPins& clocks);
  void reset();
  const Interface& find(const std::string& name, std::initializer_list<Kind> kinds) const;
  const Interface& claim(const std::string& name, std::initializer_list<Kind> kinds, bool slave);
  template <class Link>
  Link* made(const std::string& name) const;
  template <class Link>
  Link& add(std::unique_ptr<Link> link);
  Pin pin_of(const Interface& interface, const std::string& signal = "") const;
  std::size_t clock_of(const Interface& interface) const;
  Output& add_output(const std::string& name, unsigned bits);
  void follow(vp::SignalBase& signal, const Pin& pin);
  void watch_inputs();
  const vp::Clock* clock_of_writer(const vp::SignalBase& signal) const;
  void check_connections() const;
  void show_pins();
  void show_pin(const std::string& name, const void* place, unsigned bits);
  [[noreturn]] void refuse(const Interface& interface, const std::string& why) const;

  void edge_of(std::size_t clock);
  unsigned rising_now(std::size_t clock) const;
  bool in_reset() const;
  void lower(bool inputs_changed);
  bool has_note(const std::string& what, const std::string& port = "") const;
  bool clocks_fall_unseen() const;
  std::uint64_t now_ps() const;
  void settle();
  void show_outputs();
  void rest(unsigned risen);
  void begin(RtlLink& slave, bool behind_edge);
  void wake();

  std::string kind_;
  vp::Parameter<std::uint64_t> seed_;
  vp::Parameter<std::string> figures_;
  vp::Parameter<std::string> registers_;
  std::unique_ptr<pl::RtlObject> rtl_;
  std::vector<Interface> interfaces_;
  std::vector<std::unique_ptr<Side>> sides_;  ///< one for each clock
  std::vector<std::uint8_t*> levels_;         ///< of the clocks
  bool is_logic_ = false;                     ///< has no clock
  bool fall_unseen_ = false;                  ///< nothing in the RTL waits for a clock to fall
  bool registered_ = false;                   ///< outputs change with edges alone
  std::map<std::string, bool> connected_;     ///< by interface, once it is

  struct ResetPin {
    Pin pin;
    bool active_low;
  };
  std::vector<ResetPin> resets_;
  bool in_reset_ = false;  ///< one of them is active
  struct ResetSignal {
    vp::SignalBase* signal;
    bool active_low;
    std::size_t clock;
  };
  std::vector<ResetSignal> reset_signals_;
  std::vector<std::unique_ptr<RtlLink>> links_;
  std::vector<RtlLink*> buses_;     ///< those whose adapters drive inputs
  std::vector<RtlLink*> streams_;   ///< those whose signals follow outputs
  std::vector<RtlLink*> samplers_;  ///< those that look at each edge
  std::deque<Output> outputs_;
  struct Input {
    vp::SignalBase* signal;
    Pin pin;
    bool has_edge;  ///< something in the RTL waits for its edge, as for that of a clock
    bool resets;
  };
  std::vector<Input> inputs_;
  struct NamedInput {
    const Interface* interface;
    vp::SignalBase* signal;
  };
  std::vector<NamedInput> named_inputs_;  ///< resets and wires
  InputChecker checker_{*this};
  std::vector<std::unique_ptr<vp::SignalBase>> probes_;

  vp::Signal<bool> settles_{"settles"};  ///< turned when an input has changed: see on_change()
  std::uint64_t edge_ps_ = vp::Clock::never, settle_ps_ = 0;
  unsigned settled_ = 0;  ///< times at settle_ps_
  std::unique_ptr<pl::RtlRest> rest_;
  std::unique_ptr<pl::RtlActivity> activity_;
};

template <class T>
vp::Signal<T>& RtlPart::output(const std::string& name) {
  for (Output& output : outputs_) {
    if (output.name != name) continue;
    if (auto* signal = dynamic_cast<vp::Signal<T>*>(output.signal.get())) return *signal;
  }
  Output& output = add_output(name, vp::default_width<T>());
  const vp::HierarchyScope inside(*this);
  auto signal = std::make_unique<vp::Signal<T>>(name.c_str(), output.pin.bits());
  vp::Signal<T>& made = *signal;
  output.write = [&made](std::uint64_t value) { made = static_cast<T>(value); };
  made.defer_writes();
  output.signal = std::move(signal);
  return made;
}

}  // namespace axi
