#include "cuda/discrete/cuda_law.hpp"

#include "collision/integrate.hpp"

namespace quadrille::cuda {

template <class Real>
void CudaLaw<Real>::begin(const LawBodies<Real>& bodies, Step<Real>& step) {
    records_.clear();
    unfetched_ = 0;
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
        if (step.keepContacts) {
            unfetched_ = step.counts.contacts - before;
            lastStep_ = step.parameters;
        }
        bodies_.writeBack(bodies, step.clock);
    }
    return step.to;
}

template <class Real>
std::span<const ContactRecord> CudaLaw<Real>::contacts() {
    if (unfetched_ > 0) fetchContacts(unfetched_, lastStep_, records_);
    unfetched_ = 0;
    return records_;
}

template <class Real>
std::size_t CudaLaw<Real>::bytes() const {
    return device_.memoryUsed() + bodies_.hostBytes() + cells_.hostBytes() +
           records_.capacity() * sizeof(ContactRecord);
}

template class CudaLaw<double>;
template class CudaLaw<float>;

}  // namespace quadrille::cuda
