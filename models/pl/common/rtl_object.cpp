#include <pl/common/rtl_object.h>

#include <dlfcn.h>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/foreign_object.h>
#include <vp/report.h>
#include <vp/unit.h>

namespace pl {

namespace {

constexpr const char* rebuild = "build it with markervp_add_rtl() of this markervp";

}  // namespace

const RtlDescriptor& open_rtl(const std::string& file) {
  const std::string whose = "RTL '" + file + "' ";
  void* library = vp::load_object(vp::rtl_object, file);
  vp::keep_object(vp::rtl_object, file, library);
  void* symbol = ::dlsym(library, RTL_SYMBOL);
  if (!symbol) throw vp::InputError(whose + "is not RTL: it has no '" RTL_SYMBOL "'; " + rebuild);
  const RtlDescriptor* rtl = nullptr;
  std::uint32_t interface = 0;
  const std::string stopped = vp::stopped_by([&] {
    rtl = reinterpret_cast<const RtlDescriptor* (*)()>(symbol)();
    interface = rtl->interface;
  });
  if (!stopped.empty()) throw vp::ProtocolError(whose + "is damaged: " + stopped + "; " + rebuild);
  if (interface != RTL_INTERFACE) {
    throw vp::InputError(whose + "has interface " + std::to_string(interface) + ", this is " +
                         std::to_string(RTL_INTERFACE) + ": " + rebuild);
  }
  return *rtl;
}

RtlObject::RtlObject(const std::string& file, std::uint64_t seed, const std::string& instance,
                     const vp::Clock& clock)
    : file_(file),
      seed_(seed),
      instance_(instance),
      clock_(clock),
      rtl_(open_rtl(file)),
      model_(rtl_.create(instance.c_str(), seed), rtl_.destroy) {}

const RtlPort* RtlObject::find(const std::string& name) const {
  for (std::uint32_t i = 0; i < rtl_.port_count; ++i) {
    if (rtl_.ports[i].name == name) return &rtl_.ports[i];
  }
  return nullptr;
}

std::string RtlObject::start() const {
  return seed_ < 2 ? std::to_string(seed_) : "random values (seed " + std::to_string(seed_) + ")";
}

vp::IpEstimate::Foreign RtlObject::foreign() const {
  vp::IpEstimate::Foreign foreign;
  foreign.file = file_;
  foreign.sources.assign(rtl_.sources, rtl_.sources + rtl_.source_count);
  for (std::uint32_t i = 0; i < rtl_.parameter_count; ++i)
    foreign.parameters[rtl_.parameters[i].name] = rtl_.parameters[i].value;
  return foreign;
}

void RtlObject::ended(const RtlEnd& end) const {
  const std::string place = *end.place ? std::string(" (") + end.place + ")" : "";
  const std::string text = "RTL '" + file_ + "' ended itself behind edge " +
                           std::to_string(clock_.cycle()) + " of " + clock_.name() + ", at " +
                           vp::format_time(clock_.scheduler().now_ps()) + ": " + end.why + place;
  const sc_core::sc_object* module = sc_core::sc_find_object(instance_.c_str());
  if (module && sc_core::sc_is_running()) vp::error(*module, rtl_ended, text);
  throw vp::ProtocolError(instance_ + ": " + text);
}

}  // namespace pl
