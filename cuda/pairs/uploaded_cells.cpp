#include "cuda/pairs/uploaded_cells.hpp"

#include <span>

namespace quadrille::cuda {

template <class Real>
void UploadedCells<Real>::update(const Partition<Real>& partition, PhaseClock& clock) {
    if (generation_ == partition.generation) return;
    const Cells& cells = partition.cells;
    PackedUpload& u = upload_;
    u.clear();
    const std::size_t offsets = u.add(std::span<const std::uint32_t>(cells.offsets));
    const std::size_t bodies = u.add(std::span<const BodyRef>(cells.bodies));
    std::span<const CellCoordinates> owners;
    if (partition.complete) owners = cells.coordinates;
    const std::size_t coordinates = u.add(owners);
    u.flatten(device_.team());
    clock.finish(Phase::Flatten);
    device_.begin(Phase::CopyToDevice, clock);
    u.send(device_.launch().stream);
    device_.end(Phase::CopyToDevice, clock);
    cells_ = {.offsets = u.on<const std::uint32_t>(offsets),
              .bodies = u.on<const BodyRef>(bodies),
              .cellOfEntry = nullptr,
              .cells = static_cast<std::uint32_t>(cells.size()),
              .entries = static_cast<std::uint32_t>(cells.bodies.size())};
    ownership_ = {.coordinates = u.on<const CellCoordinates>(coordinates),
                  .grid = partition.grid,
                  .margin = partition.margin};
    generation_ = partition.generation;
}

template class UploadedCells<double>;
template class UploadedCells<float>;

}  // namespace quadrille::cuda
