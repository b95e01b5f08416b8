#include "cuda/resident/device_static_map.hpp"

#include <cstdint>
#include <span>

namespace quadrille::cuda {

template <class Real>
void DeviceStaticMap<Real>::load(const BodyView<Real>& bodies) {
    if (!map_.update(bodies) || empty()) return;
    view_ = map_.view();
    const std::size_t cells = view_.side * view_.side;
    PackedUpload& u = upload_;
    u.clear();
    const std::size_t boxes = u.add(std::span(view_.boxes, map_.size()));
    const std::size_t offsets = u.add(std::span(view_.offsets, cells + 1));
    const std::size_t members = u.add(std::span(view_.members, view_.offsets[cells]));
    const std::size_t crowded = u.add(std::span(view_.crowded, cells));
    u.flatten(device_.team());
    u.send(device_.launch().stream);
    view_.boxes = u.on<const Box<Real>>(boxes);
    view_.offsets = u.on<const std::uint32_t>(offsets);
    view_.members = u.on<const std::uint32_t>(members);
    view_.crowded = u.on<const std::uint8_t>(crowded);
}

template class DeviceStaticMap<double>;
template class DeviceStaticMap<float>;

}  // namespace quadrille::cuda
