#include <pl/axi_image_store/axi_image_store.h>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>

namespace pl {

namespace {

class AxiImageStoreClocked : public AxiImageStore {
 public:
  AxiImageStoreClocked(sc_core::sc_module_name name, const Site& site)
      : AxiImageStore(name, site) {}

 private:
  void edge() override { store_beat(); }
};

/// Takes whole bursts, but single beats while the memory is being read and when `ena` or `rst`
/// changes in the middle of a burst.
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
       model<AxiImageStore, AxiImageStoreTlm>("tlm", no_image, no_image)},
      rtl_model<AxiImageStore, AxiImageStoreClocked>()};
  return models;
}

void AxiImageStore::connect(IpPorts& ports) {
  ports.input(ena);
  ports.input(rst);
  ports.input(m.tdata);
  ports.input(m.tvalid);
  ports.output<bool>(
      "m_tready", 1, [this]() -> auto& { return m.link().tready; });
  ports.output("bram_addr", address);
  const auto passes = [this] { return m.tvalid.read() && m.tready.get(); };
  std::function<void(std::uint64_t)> take_word, take_enable;
  if (!ports.watched) {
    ports.before_edge = [this] { m.sample(); };
    take_word = [this](std::uint64_t word) { rtl_word_ = static_cast<std::uint32_t>(word); };
    take_enable = [this](std::uint64_t enable) {
      if (enable != 0) bram->write_a(address, rtl_word_);
    };
  }
  ports.memory_outputs = {{"bram_din", 32, take_word,
                           [this, passes]() -> std::optional<std::uint64_t> {
                             if (!passes()) return std::nullopt;
                             return m.tdata.read();
                           }},
                          {"bram_we", 1, take_enable, [passes]() -> std::optional<std::uint64_t> {
                             return passes() ? 1 : 0;
                           }}};
  ports.others_stand_still = [passes] { return !passes(); };  // each beat that passes is written
  ports.parameter("ADDRESS_BITS", "pl.width", address.width());
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
  vp::IpEstimate e = rtl_ip("axi_image_store");
  e.active_clocks = [] { return std::uint64_t{0}; };
  return e;
}

}  // namespace pl
