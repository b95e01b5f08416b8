#include <bit>
#include <type_traits>

#include <quadrille/creation_ranks.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/rules/mix64.hpp"

namespace quadrille {

namespace {

template <class Real>
std::uint64_t bitsOf(Real value) {
    using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
    return std::bit_cast<Bits>(value == 0 ? Real(0) : value);
}

}  // namespace

std::uint64_t stateHash(const World& world) {
    return world.visitBodies([](const auto& bodies) {
        const auto& m = bodies.moving;
        // 2^64 / golden ratio: neighbouring positions get unrelated offsets (Knuth, TAOCP 6.4).
        constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;
        std::uint64_t sum = mix64(m.size());
        std::uint64_t position = 0;
        const CreationRanks ranks(m.created, m.size());
        for (std::size_t place = 0; place < m.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            for (const auto value : {m.x[i], m.y[i], m.vx[i], m.vy[i]}) {
                sum += mix64(mix64(bitsOf(value)) + ++position * golden);
            }
        }
        return mix64(sum);
    });
}

}  // namespace quadrille
