#pragma once

#include <deque>
#include <memory>
#include <string>

#include <chip/block_design/shelf.h>

namespace platform {
class Design;
}

namespace platform::block_design {

struct Placement;
struct Placed;
struct Surroundings;

/// An IP that an application brings, beside those of the vendor: what is on the shelf of it, and
/// what a design delivers that has one. Its RTL, where an import finds it, goes before its model.
struct OwnIp {
  IpRule rule;  ///< with its maker
  /// Makes it (chip/block_design/place.h). Throws vp::InputError for what cannot be built.
  Placed (*place)(const Placement& at);
  /// What a design with this part delivers, model or RTL: all of Design but the module. Called once
  /// the design is wired; throws vp::InputError if it lacks what the part needs around it. Null:
  /// nothing that the platform does not know.
  std::unique_ptr<Design> (*deliver)(const Surroundings& at) = nullptr;
};

/// Puts an IP on the shelf: one object of an application, before main().
class IpRegistration {
 public:
  explicit IpRegistration(OwnIp ip);
};

/// Those of this program.
const std::deque<OwnIp>& own_ips();
/// The one of a VLNV; null if no application brought it.
const OwnIp* own_ip(const std::string& vlnv);

}  // namespace platform::block_design
