#include "collision/static_map.hpp"

#include <algorithm>

namespace quadrille {

template <class Real>
bool StaticMap<Real>::update(const BodyView<Real>& bodies) {
    if (!take(bodies)) return false;
    if (empty()) return true;
    makeGrid();
    fill();
    return true;
}

/// Takes over the boxes and the size of the largest moving body. Returns whether any has changed.
template <class Real>
bool StaticMap<Real>::take(const BodyView<Real>& bodies) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    Real largest = std::max(m.halfWidth.common, m.halfHeight.common);
    for (const auto values : {m.halfWidth.values, m.halfHeight.values}) {
        for (const Real half : values) largest = std::max(largest, half);
    }
    bool changed = largest != largest_ || boxes_.size() != f.size();
    largest_ = largest;
    boxes_.resize(f.size());
    for (std::size_t k = 0; k < f.size(); ++k) {
        const Box<Real> box{f.x[k], f.y[k], f.halfWidth[k], f.halfHeight[k]};
        Box<Real>& old = boxes_[k];
        changed |= box.x != old.x || box.y != old.y || box.halfWidth != old.halfWidth ||
                   box.halfHeight != old.halfHeight;
        old = box;
    }
    return changed;
}

/// As fine as it can be without becoming much larger than the boxes are many.
template <class Real>
void StaticMap<Real>::makeGrid() {
    constexpr std::size_t finest = 256;
    Real lowX = boxes_[0].x, highX = lowX, lowY = boxes_[0].y, highY = lowY;
    for (const Box<Real>& box : boxes_) {
        lowX = std::min(lowX, box.x - box.halfWidth);
        highX = std::max(highX, box.x + box.halfWidth);
        lowY = std::min(lowY, box.y - box.halfHeight);
        highY = std::max(highY, box.y + box.halfHeight);
    }
    // Room for a body, and to be moved by half its size.
    clearance_ = 2 * largest_;
    for (side_ = finest;; side_ /= 2) {
        const auto cells = static_cast<Real>(side_);
        grid_ = {.lowX = lowX,
                 .lowY = lowY,
                 .perX = cells / (highX - lowX),
                 .perY = cells / (highY - lowY),
                 .lastX = cells - 1,
                 .lastY = cells - 1};
        if (side_ == 1 || entries() <= 4 * finest * finest + 16 * boxes_.size()) return;
    }
}

/// How many cells the boxes and what is close to them touch, each counted for itself.
template <class Real>
std::size_t StaticMap<Real>::entries() const {
    std::size_t sum = 0;
    for (const Box<Real>& box : boxes_) {
        const FineRange r = rangeOf(box, clearance_);
        sum += std::size_t(r.x1 - r.x0 + 1) * std::size_t(r.y1 - r.y0 + 1);
    }
    return sum;
}

template <class Real>
template <class Function>
void StaticMap<Real>::forEachCell(const FineRange& range, Function&& function) const {
    for (std::size_t y = range.y0; y <= range.y1; ++y) {
        for (std::size_t x = range.x0; x <= range.x1; ++x) function(y * side_ + x);
    }
}

/// Sorts the boxes into the cells that they touch.
template <class Real>
void StaticMap<Real>::fill() {
    const std::size_t cells = side_ * side_;
    offsets_.assign(cells + 1, 0);
    crowded_.assign(cells, 0);
    for (const Box<Real>& box : boxes_) {
        forEachCell(rangeOf(box, 0), [&](std::size_t cell) { ++offsets_[cell]; });
        forEachCell(rangeOf(box, clearance_), [&](std::size_t cell) { crowded_[cell] = 1; });
    }
    std::uint32_t end = 0;
    for (std::uint32_t& offset : offsets_) offset = end += offset;
    members_.resize(end);
    // From the last down, so that a cell's end becomes its start.
    for (std::size_t k = boxes_.size(); k-- > 0;) {
        forEachCell(rangeOf(boxes_[k], 0), [&](std::size_t cell) {
            members_[--offsets_[cell]] = static_cast<std::uint32_t>(k);
        });
    }
}

template <class Real>
std::size_t StaticMap<Real>::bytes() const {
    return boxes_.capacity() * sizeof(Box<Real>) + crowded_.capacity() +
           (offsets_.capacity() + members_.capacity()) * sizeof(std::uint32_t);
}

template class StaticMap<double>;
template class StaticMap<float>;

}  // namespace quadrille
