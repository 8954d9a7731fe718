#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/FootprintChecker.h"

#include <memory>

namespace parking
{
    /** \brief Least distance in metres between the body and the obstacles along \e path, to a millimetre or one
        percent; 0 when they touch. */
    double leastClearance(const FootprintChecker &checker, const Path &path);

    /** \brief Obstacles that can be asked. Cheap to copy. */
    class ParkingWorld
    {
    public:
        /** \brief Reads the obstacles of \e scenario, for its car. Throws what FootprintChecker throws.

            \param contact decides poses so near to contact that rounding does (see FootprintChecker); without one they
            count as touching */
        explicit ParkingWorld(const Scenario &scenario, ContactTestMaker contact = {});

        /** \brief The checker of the car's own rectangle. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief A checker of the rectangle enlarged by \e gap metres on every side; null where it is larger than the
            world. */
        std::shared_ptr<const FootprintChecker> enlarged(double gap) const;

    private:
        ContactTestMaker contact_;
        std::shared_ptr<const FootprintChecker> footprint_;
    };
}  // namespace parking
