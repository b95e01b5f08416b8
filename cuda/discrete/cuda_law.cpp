#include "cuda/discrete/cuda_law.hpp"

#include "collision/integrate.hpp"

namespace quadrille::cuda {

template <class Real>
void CudaLaw<Real>::begin(const LawBodies<Real>& bodies, Step<Real>& step) {
    records_.clear();
    // The device first: if it fails, nothing has moved.
    bodies_.beginStep(bodies, step);
    integrateAll(bodies, step.parameters, device_.team());
}

template <class Real>
double CudaLaw<Real>::advance(const LawBodies<Real>& bodies, const Partition<Real>& partition,
                              double, Step<Real>& step) {
    if (bodies_.movingCount() > 0) {
        cells_.update(partition, step.clock);
        const std::uint64_t before = step.counts.contacts;
        resolve(bodies, partition, step);
        const std::uint64_t found = step.counts.contacts - before;
        if (step.keepContacts && found > 0) fetchContacts(found, step.parameters, records_);
        // Last, so that a device that fails has changed nothing here.
        bodies_.writeBack(bodies, step.clock);
    }
    return step.to;
}

template <class Real>
std::size_t CudaLaw<Real>::bytes() const {
    return device_.memoryUsed() + bodies_.hostBytes() + cells_.hostBytes() +
           records_.capacity() * sizeof(ContactRecord);
}

template class CudaLaw<double>;
template class CudaLaw<float>;

}  // namespace quadrille::cuda
