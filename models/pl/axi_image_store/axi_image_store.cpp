#include <pl/axi_image_store/axi_image_store.h>

#include <pl/common/estimate.h>

namespace pl {

namespace {

class AxiImageStoreClocked final : public AxiImageStore {
 public:
  AxiImageStoreClocked(sc_core::sc_module_name name, const Site& site)
      : AxiImageStore(name, site) {}

 private:
  void edge() override { store_beat(); }
};

/// Takes whole bursts, but beat by beat while somebody reads the memory and when `ena` or `rst`
/// changes in the middle of one.
class AxiImageStoreTlm final : public AxiImageStore,
                               private vp::BurstSink,
                               private xilinx::Bram::Writer {
 public:
  AxiImageStoreTlm(sc_core::sc_module_name name, const Site& site) : AxiImageStore(name, site) {
    m.set_sink(*this);
  }

  void settle() override { m.settle(clock().cycle()); }

 private:
  void end_of_elaboration() override {
    AxiImageStore::end_of_elaboration();
    bram->set_writer(*this);
  }
  // An edge in the middle of a burst: an input changed.
  void edge() override {
    m.settle(clock().cycle() - 1);
    store_beat();
  }
  bool takes_bursts() const override { return m.tready.get() && ena && !rst && !bram->is_read(); }
  void take_burst(const std::uint32_t* words, std::uint32_t count) override {
    bram->write_a(address, words, count);
    address = address + count;
  }
};

}  // namespace

Models<AxiImageStore>& AxiImageStore::models() {
  static Models<AxiImageStore> models{
      "axi_image_store",
      {model<AxiImageStore, AxiImageStoreClocked>("clocked", no_image, no_image),
       model<AxiImageStore, AxiImageStoreTlm>("tlm", no_image, no_image)}};
  return models;
}

AxiImageStore::AxiImageStore(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk),
      Ip(&site.clk),
      address("address", marker_logic::bits_for(site.geometry.pixels() / 4, 17)) {
  wake_on(ena);
  wake_on(rst);
  wake_on(m.tvalid);
}

void AxiImageStore::store_beat() {
  const bool enabled = ena && !rst;
  if (m.sample()) {
    bram->write_a(address, m.tdata);
    address = address + 1;
  }
  if (rst || (enabled && !ena_before_)) address = 0;
  ena_before_ = enabled;
  m.tready = enabled;
  if (!m.tvalid) sleep();
}

// An address counter. Works while an image is uploaded, which is not part of a frame.
vp::IpEstimate AxiImageStore::own_estimate() const {
  vp::IpEstimate e = small_ip("axi_image_store", 50, 60, 100 * mhz);
  e.active_clocks = [] { return std::uint64_t{0}; };
  return e;
}

}  // namespace pl
