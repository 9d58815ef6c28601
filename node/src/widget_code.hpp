#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "burin/common/transfer_function.hpp"
#include "value_scale.hpp"

namespace burin::node {

/// Vectors of one widget in the uniform array of a layer's two-dimensional transfer function:
/// 0  first and last value it shows, and of triangles and rectangles 1 / falloff in value and
///    1 - falloff
/// 1  its edges at m, values from the first on: lower x + y m, upper z + w m; of an ellipse
///    1 / half width in y, m of the centre in z, 1 / half height in w
/// 2  of triangles and rectangles, the part of extinction at m: min((m - x) y, (z - m) w)
/// 3  linear colour, largest extinction
inline constexpr std::size_t kRowsPerWidget = 4;

/// The array's elements; values as textures store them. The function's unit length is resolved.
std::vector<glm::vec4> widgetRows(const TransferFunction& function, const ValueScale& scale);

/// GLSL expression: 1 if any widget may show a value between two, else 0. `rows`: the array's name;
/// `front`, `back`: expressions of the values.
std::string widgetsShow(const TransferFunction& function, const std::string& rows,
                        const std::string& front, const std::string& back);
/// GLSL statements that declare vec4 `widgetSum`: (extinction * colour, extinction), means between
/// two values at m, the expression `magnitude`.
std::string sumWidgets(const TransferFunction& function, const std::string& rows,
                       const std::string& front, const std::string& back,
                       const std::string& magnitude);

}  // namespace burin::node
