#include <xilinx/proc_sys_reset/proc_sys_reset.h>

#include <xilinx/common/axi_lite_ip.h>
#include <initializer_list>

namespace xilinx {

namespace {

constexpr std::uint32_t steps = 3;  // bus, peripherals, processor

}  // namespace

ProcSysReset::ProcSysReset(sc_core::sc_module_name name, vp::Clock& slowest_sync_clk)
    : Clocked(name, slowest_sync_clk),
      Ip(&slowest_sync_clk),
      released_at_start("released_at_start", true, vp::Source::decision,
                        "the design was configured and reset before time 0; off: time 0 is the end "
                        "of configuration"),
      synchroniser_stages("synchroniser_stages", 4, vp::Unit::cycles, {0, 16}, vp::Source::assumed,
                          "flip-flops between a reset input and its filter"),
      external_width("external_width", 4, vp::Unit::cycles, {1, 16}, vp::Source::published,
                     "clocks for which a reset input must hold its level (PG164)"),
      step_clocks("step_clocks", 16, vp::Unit::cycles, {1, 64}, vp::Source::published,
                  "clocks between the releases of bus, peripherals and processor (PG164)"),
      bus_struct_reset("bus_struct_reset", 1, !released_at_start),
      interconnect_aresetn("interconnect_aresetn", 1, released_at_start),
      peripheral_reset("peripheral_reset", 1, !released_at_start),
      peripheral_aresetn("peripheral_aresetn", 1, released_at_start),
      mb_reset("mb_reset", 1, !released_at_start),
      filtered_(!released_at_start),
      sequence_(released_at_start ? steps * step_clocks : 0) {
  // Resets pass logic without a clock on their way to the modules of several clocks.
  for (vp::SignalBase* output :
       std::initializer_list<vp::SignalBase*>{&bus_struct_reset, &interconnect_aresetn,
                                              &peripheral_reset, &peripheral_aresetn, &mb_reset}) {
    output->defer_writes();
  }
}

// Its inputs may be left open.
void ProcSysReset::end_of_elaboration() {
  for (vp::In<bool>* input : {&ext_reset_in, &aux_reset_in, &dcm_locked}) {
    if (input->bound()) input->signal()->attach(*this);
  }
}

bool ProcSysReset::requested() const {
  return (ext_reset_in.bound() && !ext_reset_in) || (aux_reset_in.bound() && aux_reset_in) ||
         (dcm_locked.bound() && !dcm_locked);
}

// Works after a reset only.
vp::IpEstimate ProcSysReset::own_estimate() const {
  vp::IpEstimate e = axi_estimate("proc_sys_reset", 20, 40, 0);
  e.active_clocks = [] { return std::uint64_t{0}; };
  return e;
}

void ProcSysReset::edge() {
  const std::uint32_t reaction = synchroniser_stages + external_width;
  const bool request = requested();
  differs_ = request == filtered_ ? 0 : differs_ + 1;
  if (differs_ >= reaction) {
    filtered_ = request;
    differs_ = 0;
    sequence_ = 0;
    if (filtered_) drive(true, true, true);
  } else if (!filtered_ && sequence_ < steps * step_clocks) {
    ++sequence_;
    drive(sequence_ < step_clocks, sequence_ < 2 * step_clocks, sequence_ < steps * step_clocks);
  }
  const bool at_rest = differs_ == 0 && (filtered_ || sequence_ == steps * step_clocks);
  if (at_rest && requested() == filtered_) sleep();
}

void ProcSysReset::drive(bool bus, bool peripheral, bool processor) {
  bus_struct_reset = bus;
  interconnect_aresetn = !bus;
  peripheral_reset = peripheral;
  peripheral_aresetn = !peripheral;
  mb_reset = processor;
}

}  // namespace xilinx
