#pragma once

#include <cstddef>
#include <functional>

namespace parking::search
{
    /** \brief Asked now and then whether to stop; true stops the search. */
    using StopFunction = std::function<bool()>;

    /** \brief Asks a StopFunction once for so much work, and never again after it has said yes. */
    class Patience
    {
    public:
        /** \brief \param stop must outlive it; may be empty \param workBetween one question and the next */
        Patience(const StopFunction &stop, std::size_t workBetween) : stop_(stop), workBetween_(workBetween)
        {
        }

        /** \brief Is it time to stop? Says so once it is, without the work that \e comes next. */
        bool isOver(std::size_t comes = 1)
        {
            done_ += comes;
            if (!isOver_ && done_ > workBetween_)
            {
                done_ = comes;
                isOver_ = stop_ && stop_();
            }
            return isOver_;
        }

        /** \brief Has it been time to stop? */
        bool wasOver() const
        {
            return isOver_;
        }

    private:
        const StopFunction &stop_;
        std::size_t workBetween_, done_{0};
        bool isOver_{false};
    };
}  // namespace parking::search
