"""What positions and velocities tell of an answer, whoever gave it.

A state is a row a ball: position, velocity, spin. Contacts are found here, by distance, between balls and with floor and walls.
"""

import numpy as np

import pile


class Measure:
    """Judges the states of one pile."""

    def __init__(self, radii, width, step):
        self.radii, self.width, self.step = radii, width, step
        self.mass = pile.DENSITY * 4 / 3 * np.pi * radii**3

    def pairs(self, points):
        """Indices of balls whose bounding boxes in a grid of cells are neighbours, each pair once."""
        size = 2 * self.radii.max()
        cells = np.floor((points - points.min(axis=0)) / size).astype(np.int64) + 1
        extent = cells.max(axis=0) + 2
        keys = (cells[:, 0] * extent[1] + cells[:, 1]) * extent[2] + cells[:, 2]
        order = np.argsort(keys, kind="stable")
        inside = keys[order]
        found = []
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                for dz in (-1, 0, 1):
                    near = keys + (dx * extent[1] + dy) * extent[2] + dz
                    first, last = np.searchsorted(inside, near, "left"), np.searchsorted(inside, near, "right")
                    for k in range((last - first).max()):
                        has = np.flatnonzero(first + k < last)
                        found.append(np.column_stack([has, order[first[has] + k]]))
        both = np.vstack(found)
        return both[both[:, 0] < both[:, 1]]

    def contacts(self, state):
        """Gap and normal velocity (positive where it opens) of all pairs that are near each other."""
        points, velocity = state[:, :3], state[:, 3:6]
        a, b = self.pairs(points).T
        across = points[b] - points[a]
        distance = np.linalg.norm(across, axis=1)
        gaps = [distance - self.radii[a] - self.radii[b]]
        speeds = [np.einsum("ij,ij->i", across / distance[:, None], velocity[b] - velocity[a])]
        for point, normal in pile.walls(self.width):
            gaps.append((points - np.array(point)) @ np.array(normal) - self.radii)
            speeds.append(velocity @ np.array(normal))
        return np.concatenate(gaps), np.concatenate(speeds)

    def overlap(self, state):
        """The deepest overlap over the mean radius."""
        return max(0.0, -self.contacts(state)[0].min()) / self.radii.mean()

    def approach(self, state):
        """The fastest approach at a closed contact, over g h: what gravity adds in a step.

        Closed is what has no more than a ten thousandth of the radius of gap, and that much may be closed within a step. A ball
        that is about to hit another is no fault of the step before, so wider gaps do not count.
        """
        gaps, speeds = self.contacts(state)
        closed = gaps <= 1e-4 * self.radii.mean()
        excess = -speeds[closed] - np.maximum(gaps[closed], 0.0) / self.step
        return excess.max(initial=0.0) / (pile.GRAVITY * self.step)

    def kinetic(self, state):
        """Kinetic energy over m g r, summed over all balls: the height to which it would lift them all, in radii."""
        speed = (state[:, 3:6] ** 2).sum(axis=1)
        spin = (state[:, 6:9] ** 2).sum(axis=1)
        energy = 0.5 * self.mass * (speed + 0.4 * self.radii**2 * spin)
        return energy.sum() / self.weight()

    def energy(self, state):
        """Kinetic and potential energy in the same measure."""
        return self.kinetic(state) + (self.mass * pile.GRAVITY * state[:, 2]).sum() / self.weight()

    def weight(self):
        return (self.mass * pile.GRAVITY).sum() * self.radii.mean()

    def creep(self, before, after):
        """Root mean square of how far balls went between two states, over the mean radius."""
        return np.sqrt(((after[:, :3] - before[:, :3]) ** 2).sum(axis=1).mean()) / self.radii.mean()
