#include <vp/axi_stream.h>

#include <stdexcept>
#include <string>

#include <vp/stream_checker.h>

namespace vp {

namespace {

[[noreturn]] void second_end(const AxiStream& link, const char* end) {
  throw std::logic_error(std::string(link.name()) + ": a second " + end + " is bound to this link");
}

}  // namespace

AxiStream::AxiStream(sc_core::sc_module_name name) : sc_module(name) {}

AxiStream::~AxiStream() = default;

void AxiStream::check_beat(std::uint8_t keep, bool last) {
  if (checker_) checker_->pass(keep, last);
}

void AxiStream::excuse() {
  if (checker_) checker_->excuse();
}

void AxiStream::end_of_simulation() {
  if (checker_) checker_->finish();
}

void AxiStream::pass_singly(StreamFault* fault) {
  const bool elaborates = sc_core::sc_get_status() < sc_core::SC_END_OF_ELABORATION;
  if (!elaborates && rests())
    throw std::logic_error(std::string(name()) + ": its beats do not pass one by one");
  slave_takes_source_ = false;
  sink_ = nullptr;
  fault_ = fault;
}

void AxiStream::start_of_simulation() {
  if (!master_ || !slave_) return;
  std::vector<StreamChecker::Reset> resets;
  for (const AxiStreamMaster::Reset& reset : master_->resets_) {
    if (SignalBase* signal = reset.signal()) resets.push_back({signal, reset.active_low});
  }
  checker_ = std::make_unique<StreamChecker>(*this, slave_->clock(), resets);
}

AxiStreamMaster::AxiStreamMaster(const char* name, Clocked& owner)
    : tdata(&owner),
      tkeep(&owner),
      tvalid(&owner),
      tlast(&owner),
      tready((std::string(name) + "_tready").c_str(), &owner) {}

void AxiStreamMaster::bind(AxiStream& link) {
  if (link.master_) second_end(link, "master");
  link.master_ = this;
  link_ = &link;
  tdata(link.tdata);
  tkeep(link.tkeep);
  tvalid(link.tvalid);
  tlast(link.tlast);
  tready(link.tready);
}

AxiStreamSlave::AxiStreamSlave(const char* name, Clocked& owner)
    : tdata((std::string(name) + "_tdata").c_str(), &owner),
      tkeep((std::string(name) + "_tkeep").c_str(), &owner),
      tvalid((std::string(name) + "_tvalid").c_str(), &owner),
      tlast((std::string(name) + "_tlast").c_str(), &owner),
      tready(&owner),
      owner_(owner) {}

void AxiStreamSlave::bind(AxiStream& link) {
  if (link.slave_) second_end(link, "slave");
  link.slave_ = &owner_;
  link.slave_takes_source_ = takes_source_;
  link.sink_ = sink_;
  link_ = &link;
  tdata(link.tdata);
  tkeep(link.tkeep);
  tvalid(link.tvalid);
  tlast(link.tlast);
  tready(link.tready);
}

// While the master waits it holds its beat (tvalid must not fall), and the slave's tready changes
// on its own edges only: so the edges the slave slept through since its last look were stalls too.
void AxiStreamSlave::count_stall(bool valid) {
  const std::uint64_t cycle = owner_.clock().cycle();
  if (waiting_) {
    link_->stalls.add(cycle - last_stall_cycle_ - (valid ? 0 : 1));
  } else {
    ++link_->stalls;
  }
  waiting_ = valid;
  last_stall_cycle_ = cycle;
}

}  // namespace vp
