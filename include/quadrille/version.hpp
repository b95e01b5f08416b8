#pragma once

namespace quadrille {

inline constexpr const char* version = "0.1.0";

/// The commit that the library was built from, "unknown" outside a git checkout.
const char* commit();

}  // namespace quadrille
