#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace burin::node {

/// An HDF5 identifier and the function that closes it. Move-only.
template <auto Close>
class Hdf5Id {
 public:
  explicit Hdf5Id(hid_t id) noexcept : id_{id} {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_{std::exchange(other.id_, hid_t{-1})} {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Hdf5Id() {
    if (id_ >= 0) Close(id_);
  }
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
};
using Hdf5File = Hdf5Id<H5Fclose>;
using Hdf5Dataset = Hdf5Id<H5Dclose>;
using Hdf5Space = Hdf5Id<H5Sclose>;
using Hdf5Type = Hdf5Id<H5Tclose>;
using Hdf5Attribute = Hdf5Id<H5Aclose>;
using Hdf5PropertyList = Hdf5Id<H5Pclose>;

/// HDF5's own reason for the last failure, on one line: the innermost of its messages.
std::string hdf5Reason();

}  // namespace burin::node
