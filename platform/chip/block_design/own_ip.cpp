#include <chip/block_design/own_ip.h>

#include <algorithm>
#include <utility>

namespace platform::block_design {

namespace {

std::deque<OwnIp>& registered() {
  static std::deque<OwnIp> list;
  return list;
}

}  // namespace

IpRegistration::IpRegistration(OwnIp ip) {
  registered().push_back(std::move(ip));
}

const std::deque<OwnIp>& own_ips() {
  return registered();
}

const OwnIp* own_ip(const std::string& vlnv) {
  const auto found = std::find_if(registered().begin(), registered().end(),
                                  [&](const OwnIp& own) { return is_of(own.rule, vlnv); });
  return found == registered().end() ? nullptr : &*found;
}

}  // namespace platform::block_design
