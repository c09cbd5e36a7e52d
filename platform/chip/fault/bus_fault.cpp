#include <chip/fault/injector.h>
#include <chip/fault/places.h>
#include <vp/error.h>
#include <vp/mm_link.h>
#include <vp/router.h>

namespace platform {

namespace {

/// Where the addresses of a link begin for the processor: a region of an interconnect may count
/// from 0.
std::uint64_t base_of(const vp::MmLink& link) {
  for (const vp::Router* router : vp::all_objects<vp::Router>()) {
    for (const vp::Router::Region& region : router->regions()) {
      if (region.link == &link) return region.translation();
    }
  }
  return 0;
}

/// Answers accesses on a link with errors, or changes a bit of their data.
class BusFault : public FaultyPlace, public vp::MmObserver {
 public:
  BusFault(Injector& injector, Injection& injection, vp::MmLink& link)
      : injector_(injector), injection_(injection), link_(link), base_(base_of(link)) {
    link_.add_observer(*this);
  }
  ~BusFault() override { link_.remove_observer(*this); }

  void before(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override {
    meets_ = counts(payload) && fault().meets(++seen_);
    if (!meets_) return;
    command_ = payload.get_command();
    // A target does nothing, and answers at once.
    if (fault().what == Fault::What::decerr) payload.set_command(tlm::TLM_IGNORE_COMMAND);
    if (fault().what == Fault::What::corrupt && payload.is_write()) flip(payload);
  }

  void after(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override {
    if (!meets_) return;
    payload.set_command(command_);
    if (fault().what == Fault::What::corrupt) {
      flip(payload);  // of a write: the master's own data are as they were
    } else {
      payload.set_response_status(fault().what == Fault::What::decerr
                                      ? tlm::TLM_ADDRESS_ERROR_RESPONSE
                                      : tlm::TLM_GENERIC_ERROR_RESPONSE);
    }
    injection_.happened(injector_.zynq().scheduler.now_ps());
  }

 private:
  const Fault& fault() const { return injection_.fault; }

  bool counts(const tlm::tlm_generic_payload& payload) const {
    if (injector_.zynq().scheduler.now_ps() < fault().at_ps) return false;
    if (fault().of == Fault::Of::reads && !payload.is_read()) return false;
    if (fault().of == Fault::Of::writes && !payload.is_write()) return false;
    const bool has_bit = fault().bit / 8 < payload.get_data_length();
    if (fault().what == Fault::What::corrupt && !has_bit) return false;
    if (!fault().has_address) return true;
    const std::uint64_t first = base_ + payload.get_address();
    return fault().address >= first && fault().address - first < payload.get_data_length();
  }

  void flip(tlm::tlm_generic_payload& payload) const {
    payload.get_data_ptr()[fault().bit / 8] ^= static_cast<unsigned char>(1U << fault().bit % 8);
  }

  Injector& injector_;
  Injection& injection_;
  vp::MmLink& link_;
  const std::uint64_t base_;
  std::uint64_t seen_ = 0;
  bool meets_ = false;
  tlm::tlm_command command_ = tlm::TLM_IGNORE_COMMAND;
};

}  // namespace

std::unique_ptr<FaultyPlace> place_bus_fault(Injector& injector, Injection& injection) {
  vp::MmLink& link = place_named<vp::MmLink>(injection.fault.where, "a link of a bus");
  return std::make_unique<BusFault>(injector, injection, link);
}

}  // namespace platform
