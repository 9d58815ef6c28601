#pragma once

namespace burin::host {

/// A function of the module burin_pictures, which alone is linked with OpenImageIO
/// (picture_encoder.hpp); opens it the first time. Throws Error{kRank} naming the file.
void* pictureFunction(const char* name);

}  // namespace burin::host
