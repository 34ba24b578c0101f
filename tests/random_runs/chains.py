# SPDX-License-Identifier: MIT
"""Checks that a chain represents a bar, by the definitions of docs/reference/conventions.md. It
uses filtrations from oracle.py, and shares nothing with libph."""
import math

import oracle


class Unfit(Exception):
    """A chain that does not represent its bar; the message says why."""


def add(chain, cell, number, prime):
    total = (chain.get(cell, 0) + number) % prime
    if total:
        chain[cell] = total
    else:
        chain.pop(cell, None)


def boundary(chain, boundary_of, prime):
    """The boundary of a chain. @param boundary_of(cell) pairs (facet, coefficient)."""
    result = {}
    for cell, number in chain.items():
        for facet, coefficient in boundary_of(cell):
            add(result, facet, number * coefficient, prime)
    return result


def sum_of_loops(loops, period, prime):
    """The chain of the edges of loops. Edges are simplices or, for images, cubes in doubled
    coordinates. @param loops pairs of vertices and a coefficient. @param period for each axis of an
    image, its length in doubled coordinates if it is periodic; None for simplices."""
    chain = {}
    for vertices, coefficient in loops:
        for a, b in zip(vertices, vertices[1:] + vertices[:1]):
            if period is None:
                add(chain, (min(a, b), max(a, b)), coefficient if a < b else -coefficient, prime)
                continue
            steps = [(y - x + (length or 0)) % length if length else y - x
                     for x, y, length in zip(a, b, period)]
            axis = next(k for k, step in enumerate(steps) if step)
            forwards = steps[axis] == 2
            low = a if forwards else b
            edge = low[:axis] + (low[axis] + 1,) + low[axis + 1:]
            add(chain, edge, coefficient if forwards else -coefficient, prime)
    return chain


class Representatives:
    """Checks chains against a filtration."""

    def __init__(self, filtration, prime):
        self.filtration, self.prime = filtration, prime
        self.columns = oracle.reduced_columns(filtration, prime)

    def value(self, cell):
        if cell not in self.filtration:
            raise Unfit(f"{cell} is no cell")
        return self.filtration[cell][0]

    def is_boundary(self, chain, until):
        """True if the chain is the boundary of a chain of cells for whose values `until` holds."""
        chain = {self.columns.place[c]: a for c, a in chain.items()}
        while chain:
            low = max(chain)
            if low not in self.columns.by_lowest or not until(self.columns.value_at(low)):
                return False
            column = self.columns.by_lowest[low]
            factor = chain[low] * pow(column[low], -1, self.prime) % self.prime
            for place, number in column.items():
                add(chain, place, -factor * number, self.prime)
        return True

    def chain(self, terms):
        """The chain that the output describes. @param terms cells and coefficients, as in the
        file."""
        chain = {}
        for cell, coefficient in terms:
            if coefficient == 0 or abs(coefficient) * 2 > self.prime or (self.prime, coefficient) == (2, -1):
                raise Unfit(f"{cell} has the coefficient {coefficient}")
            if cell in chain and cell in self.filtration:
                raise Unfit(f"{cell} comes twice")
            add(chain, cell, coefficient, self.prime)
        return chain

    def check_cycle(self, chain, bar, born):
        """@param chain the coefficients of `bar` by cell. @param born the birth cell."""
        dim, birth, death = bar
        if born not in chain or self.value(born) != birth:
            raise Unfit(f"the birth cell {born} is not in it, or of another value")
        for cell in chain:
            if self.value(cell) > birth or self.filtration[cell][1] != dim:
                raise Unfit(f"{cell} is not there at the birth, or of another dimension")
        if boundary(chain, lambda cell: self.filtration[cell][2], self.prime):
            raise Unfit("it has a boundary")
        if self.is_boundary(chain, lambda value: value < death):
            raise Unfit("it is a boundary before the death")
        if death < math.inf and not self.is_boundary(chain, lambda value: value <= death):
            raise Unfit("it is no boundary at the death")

    def check_cocycle(self, cochain, bar, born, killer):
        dim, birth, death = bar
        if born not in cochain or self.value(born) != birth:
            raise Unfit(f"the birth cell {born} is not in it, or of another value")
        for cell in cochain:
            if self.value(cell) < birth or self.filtration[cell][1] != dim:
                raise Unfit(f"{cell} is older than the birth, or of another dimension")
        for cell, (value, of_dim, facets) in self.filtration.items():
            if of_dim != dim + 1 or value > death or value == death and cell != killer:
                continue
            coboundary = sum(cochain.get(facet, 0) * sign for facet, sign in facets) % self.prime
            if (coboundary != 0) != (cell == killer):
                raise Unfit(f"its coboundary on {cell} is {coboundary}")
