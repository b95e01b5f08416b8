#include "collision/static_barrier.hpp"

namespace quadrille {

template <class Real>
void StaticBarrier<Real>::update(const LawBodies<Real>& bodies) {
    if (made_ && layout_ == bodies.layout) return;
    map_.update(bodies.read());
    layout_ = bodies.layout;
    made_ = true;
}

template class StaticBarrier<double>;
template class StaticBarrier<float>;

}  // namespace quadrille
