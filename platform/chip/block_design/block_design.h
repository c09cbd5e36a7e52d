#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <systemc>
#include <vector>

#include <chip/block_design/design_file.h>
#include <chip/block_design/place.h>
#include <chip/system/design.h>
#include <chip/system/unit_source.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/mm_link.h>
#include <vp/parameter.h>
#include <vp/router.h>
#include <vp/signal.h>
#include <xilinx/axi_dma/memory_port.h>

namespace platform::block_design {

/// A pin of the chip that drives the design: a level that the user sets, or a clock.
class ExternalInput : public sc_core::sc_module {
 public:
  ExternalInput(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
                const ExternalPin& pin);
  const char* kind() const override { return "ExternalInput"; }

  std::unique_ptr<vp::Parameter<std::uint64_t>> level;      ///< null: it is a clock
  std::unique_ptr<vp::Parameter<std::uint64_t>> frequency;  ///< null: the pin is no clock
  vp::Signal<std::uint64_t> pin;
  std::unique_ptr<vp::Clock> clk;
};

/// The programmable logic as a design file describes it: its parts, wired.
///
/// Object names are those of the file: `pl.axi_dma_0`, `pl.xlconcat_0.dout`, `pl.external.btns`.
class BlockDesign : public sc_core::sc_module, public Design, public UnitSource {
 public:
  /// Throws vp::InputError with file and line for what cannot be built or joined.
  BlockDesign(sc_core::sc_module_name name, PlPorts& ports, const DesignFile& design);
  ~BlockDesign() override;
  const char* kind() const override { return "BlockDesign"; }

  facts::Work work() const override;
  bool report(const Publication& publication, facts::UnitReport& unit) override;
  facts::InputNeed input() const override { return of_own().input(); }
  void describe(const facts::UnitInput& input, hal_frame& frame) const override {
    of_own().describe(input, frame);
  }
  void place(const facts::SharedInput& input) override { of_own().place(input); }
  void settle() override { of_own().settle(); }
  std::optional<double> program_option(const std::string& name) const override {
    return of_own().program_option(name);
  }
  void note_option(const std::string& name, double value) override {
    of_own().note_option(name, value);
  }
  std::uint32_t settling_showings() const override { return of_own().settling_showings(); }
  void check(facts::UnitReport& unit) override { of_own().check(unit); }
  void finish() override { of_own().finish(); }
  vp::Signal<bool>* busy() override { return of_own().busy(); }
  void add_power_options() override { of_own().add_power_options(); }
  bool has_net_figures() const override { return of_own().has_net_figures(); }
  std::vector<std::string> groups() const override { return of_own().groups(); }
  std::vector<ClockRole> clock_roles() override;
  TimelineEngines timeline() override { return of_own().timeline(); }
  vp::SignalBase* unit_end() override { return unit_end_; }
  const std::string& unit_line() const override { return design_.unit.line; }
  std::vector<std::string> used_stubs() const override;
  const DesignFile& file() const { return design_; }

 private:
  struct Way;

  void build();
  void take_apart();
  /// What an own IP of an application delivers; a design without one delivers nothing of it.
  Design& of_own() const { return *delivery_; }
  void find_delivery();
  void place_all();
  Placed& placed(const std::string& name);
  Placed place_processing_system(const PlacedPart& part);
  vp::Clock* clock_of(const End& source);
  vp::SignalBase& signal_of(const End& source);
  std::unique_ptr<vp::Signal<std::uint64_t>> tie(const End& source);
  void join_pins(const PlacedPart& part);
  void join_serial_lines();
  void join_memories();
  void tell_of_lost_interrupt(const std::string& pin, const End& source);
  void join_streams();
  void join_stream(const End& master, const End& slave);
  vp::AxiStream& make_stream(const End& master);
  void close_open_streams();
  void join_addresses();
  bool asks(const AddressSegment& segment);
  void join_segment(const AddressSegment& segment);
  std::vector<std::string> way_between(const AddressSegment& segment) const;
  bool find_way(const End& from, const End& master, std::vector<std::string>& way,
                unsigned depth) const;
  vp::Router& router(const std::string& name);
  vp::Router& way_of(const End& master, const std::vector<std::string>& way);
  std::string number_of(const AddressSegment& segment) const;
  std::uint64_t base_of(const AddressSegment& segment);
  bool is_absolute(const End& slave);
  bool is_seen_elsewhere(const AddressSegment& segment);
  vp::Router& windows_of(const AddressSegment& segment);
  SlavePort slave_of(const AddressSegment& segment);
  RegionSocket& no_master(const std::string& name);
  void close_open_ports();
  bool is_bus(const std::string& part) const;
  [[noreturn]] void refuse(const End& end, const std::string& problem,
                           const std::vector<std::string>& names = {}) const;

  PlPorts& ports_;
  const DesignFile& design_;
  std::unique_ptr<Design> delivery_;
  bool has_own_ = false;  ///< `delivery_` is that of an own IP
  vp::SignalBase* unit_end_ = nullptr;
  std::uint64_t unit_from_ps_ = 0;  ///< end of the unit before
  std::string ps_;                  ///< the name of the processing system among the parts
  std::map<std::string, std::unique_ptr<ExternalInput>> external_;
  std::map<std::string, Placed> placed_;
  std::vector<std::string> order_;  ///< in which parts were placed: clocks before what they clock
  std::vector<std::string> being_placed_;
  std::vector<std::unique_ptr<sc_core::sc_module>> adapters_;
  std::map<std::string, std::unique_ptr<vp::Signal<std::uint64_t>>> tied_;  ///< to a level
  std::vector<std::string> lacking_;  ///< outputs that something reads and no model has
  std::deque<vp::AxiStream> streams_;
  std::deque<vp::StreamSource> silent_;
  std::deque<vp::StreamSink> blocked_;
  std::deque<vp::Router> direct_;        ///< of masters that meet no interconnect
  std::deque<vp::MmLink> tied_masters_;  ///< in the place of masters that ask for nothing
  std::map<std::string, vp::Router*> direct_of_;
  std::set<const vp::Router*> entered_;              ///< those that a master comes to
  std::map<std::string, vp::Router*> windows_of_;    ///< of slaves that are seen in several places
  std::map<std::string, vp::Router*> first_of_;      ///< where the way of a master begins
  std::map<std::string, xilinx::MemoryPath> paths_;  ///< by the port at the end
  std::map<std::string, std::unique_ptr<vp::Parameter<std::uint64_t>>> bases_;
  std::map<std::string, bool> streams_joined_;
  std::map<std::string, std::set<std::uint64_t>> mapped_;  ///< bases of a slave at a router
};

/// The design of a YAML file, ready to be built. Throws vp::InputError.
DesignInfo load(const std::string& file);

}  // namespace platform::block_design
