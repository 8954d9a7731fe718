#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief A hash table from 64-bit cell keys to node numbers: open addressing with linear probing, no erasing.

        clear() keeps the memory and costs no time: entries carry the number of the query that wrote them. */
    class CellTable
    {
    public:
        static constexpr std::uint32_t NONE = 0xffffffffu;  ///< result of find() for an empty cell

        /** \brief Creates an empty table that grows above \e slots / 2 cells; \e slots is a power of two. */
        explicit CellTable(std::size_t slots = std::size_t{1} << 12) : slots_(slots)
        {
        }

        /** \brief Removes all cells. */
        void clear()
        {
            ++generation_;
            size_ = 0;
        }

        /** \brief The number stored for a cell; NONE if it is empty. */
        std::uint32_t find(std::uint64_t key) const
        {
            for (std::size_t i = place(key);; i = (i + 1) & (slots_.size() - 1))
            {
                if (slots_[i].generation != generation_)
                    return NONE;
                if (slots_[i].key == key)
                    return slots_[i].value;
            }
        }

        /** \brief Upper limit of the bytes of its cells, including growth; slots of an earlier, larger query do not
            count. */
        std::size_t bytes() const
        {
            return 6 * size_ * sizeof(Slot);
        }

        /** \brief Inserts or overwrites. */
        void set(std::uint64_t key, std::uint32_t value)
        {
            if (2 * size_ >= slots_.size())
                grow();
            for (std::size_t i = place(key);; i = (i + 1) & (slots_.size() - 1))
            {
                Slot &slot = slots_[i];
                if (slot.generation != generation_)
                {
                    slot = {key, value, generation_};
                    ++size_;
                    return;
                }
                if (slot.key == key)
                {
                    slot.value = value;
                    return;
                }
            }
        }

    private:
        struct Slot
        {
            std::uint64_t key{0};
            std::uint32_t value{NONE};
            std::uint32_t generation{0};
        };

        std::size_t place(std::uint64_t key) const
        {
            // Fibonacci hashing after folding the high half down.
            key ^= key >> 32;
            key *= 0x9e3779b97f4a7c15ull;
            return static_cast<std::size_t>(key >> 20) & (slots_.size() - 1);
        }

        void grow()
        {
            std::vector<Slot> old(slots_.size() * 2);
            old.swap(slots_);
            const std::uint32_t generation = generation_;
            generation_ = 1;
            size_ = 0;
            for (const Slot &slot : old)
                if (slot.generation == generation)
                    set(slot.key, slot.value);
        }

        std::vector<Slot> slots_;
        std::size_t size_{0};
        std::uint32_t generation_{1};
    };
}  // namespace parking::search
