#include "hdf5_id.hpp"

#include <algorithm>

namespace burin::node {

std::string hdf5Reason() {
  std::string reason = "unknown reason";
  const auto keep = [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
    if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep, &reason);
  std::ranges::replace(reason, '\n', ' ');
  return reason;
}

}  // namespace burin::node
