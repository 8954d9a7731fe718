#pragma once

namespace parking
{
    /** \brief The page of driveAnimation(), with marks (\@DATA\@ and so on) where the drive goes. */
    extern const char *const DRIVE_ANIMATION_PAGE;
}  // namespace parking
