#include "partition_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrille {

namespace {

constexpr long double infinity = std::numeric_limits<long double>::infinity();

/// Half-open: low edges belong to it, high ones do not.
struct Rectangle {
    long double lowX, lowY, highX, highY;
};

/// The exact box of a body, inflated.
template <class Real>
Rectangle boxOf(const Boxes<Real>& boxes, std::uint32_t i, long double margin) {
    const long double x = boxes.x[i];
    const long double y = boxes.y[i];
    const long double w = boxes.halfWidth[i] + margin;
    const long double h = boxes.halfHeight[i] + margin;
    return {x - w, y - h, x + w, y + h};
}

/// Of the whole partition, in fine cells.
std::pair<std::uint32_t, std::uint32_t> extent(const Cells& cells) {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    for (const CellCoordinates& c : cells.coordinates) {
        columns = std::max(columns, c.x + (1u << c.shift));
        rows = std::max(rows, c.y + (1u << c.shift));
    }
    return {columns, rows};
}

std::string describe(std::size_t cell) { return "cell " + std::to_string(cell); }

std::string describe(std::uint32_t body, std::size_t cell) {
    return "body " + std::to_string(body) + " and " + describe(cell);
}

/// Offsets, ids and ascent.
std::string faultOfRows(const Cells& cells, std::uint32_t moving, std::uint32_t fixed) {
    if (cells.offsets.empty() || cells.offsets.front() != 0) return "offsets do not begin with 0";
    if (cells.offsets.back() != cells.bodies.size()) return "the last offset is not the end";
    if (cells.coordinates.size() != cells.size()) return "a cell has no coordinates";
    for (std::size_t c = 0; c < cells.size(); ++c) {
        if (cells.offsets[c] > cells.offsets[c + 1]) return describe(c) + ": offsets fall";
        const auto members = cells[c];
        for (std::size_t k = 0; k < members.size(); ++k) {
            const BodyRef body = members[k];
            if (body.row() >= (body.isStatic() ? fixed : moving)) {
                return describe(c) + ": no such body";
            }
            if (k > 0 && !(members[k - 1] < body)) return describe(c) + ": does not ascend";
        }
    }
    return {};
}

std::uint64_t spread(std::uint64_t bits) {
    std::uint64_t result = 0;
    for (int i = 0; i < 16; ++i) result |= (bits >> i & 1) << (2 * i);
    return result;
}

}  // namespace

template <class Real>
Boxes<Real>::Boxes(const BodyView<Real>& bodies)
    : moving(static_cast<std::uint32_t>(bodies.moving.size())) {
    const auto append = [this](const auto& kind) {
        for (std::size_t i = 0; i < kind.size(); ++i) {
            x.push_back(kind.x[i]);
            y.push_back(kind.y[i]);
            halfWidth.push_back(kind.halfWidth[i]);
            halfHeight.push_back(kind.halfHeight[i]);
        }
    };
    append(bodies.moving);
    append(bodies.fixed);
}

template <class Real>
bool Boxes<Real>::overlap(std::uint32_t a, std::uint32_t b) const {
    const Real dx = x[a] < x[b] ? x[b] - x[a] : x[a] - x[b];
    const Real dy = y[a] < y[b] ? y[b] - y[a] : y[a] - y[b];
    const Real reachX = halfWidth[a] + halfWidth[b];
    const Real reachY = halfHeight[a] + halfHeight[b];
    return dx < reachX && dy < reachY;
}

template <class Real>
PairList overlappingPairs(const Boxes<Real>& boxes) {
    PairList pairs;
    for (std::uint32_t a = 0; a < boxes.moving; ++a) {
        for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
            if (boxes.overlap(a, b)) pairs.emplace_back(a, b);
        }
    }
    return pairs;
}

template <class Real>
PairList foundPairs(NarrowPhase<Real>& narrowPhase, const BodyView<Real>& bodies,
                    const Partition<Real>& partition) {
    PairList pairs;
    const auto moving = static_cast<std::uint32_t>(bodies.moving.size());
    narrowPhase.find(
        bodies, partition, [&](MovingPair p) { pairs.emplace_back(p.a, p.b); },
        [&](StaticPair p) { pairs.emplace_back(p.a, moving + p.fixed); });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

std::string difference(const PairList& found, const PairList& expected) {
    if (found == expected) return {};
    const auto [f, e] = std::mismatch(found.begin(), found.end(), expected.begin(), expected.end());
    const auto show = [](const PairList& list, PairList::const_iterator at) {
        if (at == list.end()) return std::string("the end");
        return "(" + std::to_string(at->first) + ", " + std::to_string(at->second) + ")";
    };
    return std::to_string(found.size()) + " pairs found, " + std::to_string(expected.size()) +
           " expected; first difference: " + show(found, f) + " for " + show(expected, e);
}

template <class Real>
std::string faultOfCells(const BodyView<Real>& bodies, const Partition<Real>& partition) {
    const Cells& cells = partition.cells;
    const Boxes<Real> boxes(bodies);
    if (auto fault = faultOfRows(cells, boxes.moving, boxes.size() - boxes.moving); !fault.empty())
        return fault;

    const auto [columns, rows] = extent(cells);
    // A body may stand in a cell too many where rounding leaves it open whether it touches it.
    std::vector<Rectangle> surely, perhaps;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const long double scale = std::abs((long double)boxes.x[i]) +
                                  std::abs((long double)boxes.y[i]) + boxes.halfWidth[i] +
                                  boxes.halfHeight[i] + partition.margin + 1000;
        surely.push_back(boxOf(boxes, i, partition.margin));
        perhaps.push_back(
            boxOf(boxes, i, partition.margin + 16 * std::numeric_limits<Real>::epsilon() * scale));
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const CellCoordinates& at = cells.coordinates[c];
        const std::uint32_t side = 1u << at.shift;
        const Bounds bounds = cells.bounds(c);
        const Rectangle cell{at.x == 0 ? -infinity : bounds.low.x(),
                             at.y == 0 ? -infinity : bounds.low.y(),
                             at.x + side == columns ? infinity : bounds.high.x(),
                             at.y + side == rows ? infinity : bounds.high.y()};
        const auto touches = [&](const Rectangle& box) {
            return box.lowX < cell.highX && box.highX >= cell.lowX && box.lowY < cell.highY &&
                   box.highY >= cell.lowY;
        };
        const auto members = cells[c];
        std::size_t next = 0;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            const bool member = next < members.size() && boxes.numberOf(members[next]) == i;
            next += member;
            if (!member && touches(surely[i]))
                return describe(i, c) + " touch, but it is not there";
            if (member && !touches(perhaps[i]))
                return describe(i, c) + " are apart, but it is there";
        }
    }
    return {};
}

template <class Real>
std::string faultOfTree(const BodyView<Real>& bodies, const Partition<Real>& partition,
                        int maxDepth, int maxPerCell) {
    const Cells& cells = partition.cells;
    const Boxes<Real> boxes(bodies);
    const long double fineX = cells.fineCell.x();
    const long double fineY = cells.fineCell.y();
    std::uint64_t code = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const CellCoordinates& at = cells.coordinates[c];
        // Leaves in Z order, each beginning where the last one ended, leave neither gap nor
        // overlap.
        if ((spread(at.x) | spread(at.y) << 1) != code) return describe(c) + " breaks the Z order";
        code += 1ull << (2 * at.shift);

        const auto members = cells[c];
        if (members.size() <= static_cast<std::size_t>(maxPerCell) || at.shift == 0) continue;
        const Bounds bounds = cells.bounds(c);
        for (const BodyRef body : members) {
            const std::uint32_t i = boxes.numberOf(body);
            // It reaches into the first and the last of the leaf's fine cells, two different ones.
            const Rectangle box = boxOf(boxes, i, partition.margin);
            const long double slack =
                16 * std::numeric_limits<Real>::epsilon() *
                (std::abs((long double)boxes.x[i]) + std::abs((long double)boxes.y[i]) +
                 boxes.halfWidth[i] + boxes.halfHeight[i] + partition.margin + 1000);
            const bool covers = box.lowX < bounds.low.x() + fineX + slack &&
                                box.lowY < bounds.low.y() + fineY + slack &&
                                box.highX >= bounds.high.x() - fineX - slack &&
                                box.highY >= bounds.high.y() - fineY - slack;
            if (!covers) return describe(c) + " holds too many bodies";
        }
    }
    if (code != 1ull << (2 * maxDepth)) return "the leaves do not fill the world";
    return {};
}

#define QUADRILLE_INSTANTIATE(Real)                                                   \
    template struct Boxes<Real>;                                                      \
    template PairList overlappingPairs(const Boxes<Real>&);                           \
    template PairList foundPairs(NarrowPhase<Real>&, const BodyView<Real>&,           \
                                 const Partition<Real>&);                             \
    template std::string faultOfCells(const BodyView<Real>&, const Partition<Real>&); \
    template std::string faultOfTree(const BodyView<Real>&, const Partition<Real>&, int, int);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)
#undef QUADRILLE_INSTANTIATE

}  // namespace quadrille
