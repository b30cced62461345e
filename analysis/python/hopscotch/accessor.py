"""What a map knows beyond its numbers: names, colours, attractors, pictures."""

import numpy as np
import xarray as xr

from . import drawing

UNDECIDED = "#3a3a3a"
# Okabe and Ito's colours, told apart with every kind of colour vision.
DISTINCT = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442")


@xr.register_dataset_accessor("hop")
class HopAccessor:
    """``dataset.hop``: see the methods."""

    def __init__(self, dataset):
        self._dataset = dataset

    def names(self, layer="label"):
        """``{value: name}`` of a layer with named values (labels, outcomes)."""
        attributes = self._dataset[layer].attrs
        if "flag_values" not in attributes:
            return {}
        values = np.atleast_1d(attributes["flag_values"]).tolist()
        names = dict(zip(values, attributes["flag_meanings"].split()))
        if layer == "label" and "attractor_label" in self._dataset.coords:
            labels = self._dataset["attractor_label"].values.tolist()
            names.update(zip(labels, self._dataset["attractor"].values.tolist()))
        return names

    def palette(self, layer="label"):
        """``{value: "#rrggbb"}`` of a layer with named values."""
        colours = {}
        for i, (value, name) in enumerate(self.names(layer).items()):
            open_end = name in ("none", "budget", "not_finite", "unresolved_event")
            colours[value] = UNDECIDED if open_end else DISTINCT[i % len(DISTINCT)]
        if layer == "label" and "attractor_label" in self._dataset.coords:
            labels = self._dataset["attractor_label"].values.tolist()
            colours.update(zip(labels, self._dataset["attractor_colour"].values.tolist()))
        return colours

    def attractors(self):
        """One dictionary per attractor: label, name, period, points, multipliers, trap, share, colour."""
        if "attractor" not in self._dataset.coords:
            return []
        return [self._attractor(i) for i in range(self._dataset.sizes["attractor"])]

    def is_in(self, name, layer="label"):
        """Where the cells of a layer have the value of that name (boolean array)."""
        for value, known in self.names(layer).items():
            if known == name:
                return self._dataset[layer] == value
        raise KeyError(f"{name!r} is none of {sorted(self.names(layer).values())}")

    def shares(self, layer="label"):
        """``{name: share of all cells}`` of a layer with named values, largest first."""
        values, counts = np.unique(self._dataset[layer].values, return_counts=True)
        names = self.names(layer)
        shares = {names.get(v, str(v)): n / counts.sum()
                  for v, n in zip(values.tolist(), counts.tolist())}
        return dict(sorted(shares.items(), key=lambda item: -item[1]))

    def plot(self, layer=None, ax=None, **cells):
        """Draws a layer with matplotlib and returns the axes.

        ``layer`` is ``label`` by default, else the first one; further axes than two are fixed at
        their first cell unless named: ``plot("label", restitution=3)``. Of the index of a sweep,
        layers are drawn for one map (``plot("label", stride_period=4)``), its table over the sweep.
        """
        if layer is None:
            layer = "label" if "label" in self._dataset else next(iter(self._dataset.data_vars))
        return drawing.draw(self._dataset, self._dataset[layer], self.names(layer),
                            self.palette(layer), ax, cells)

    def _attractor(self, i):
        row = self._dataset.isel(attractor=i)
        result = {"label": int(row["attractor_label"]), "name": str(row["attractor"].values),
                  "period": int(row["attractor_period"]), "share": float(row["attractor_share"]),
                  "trap": str(row["attractor_trap"].values),
                  "colour": str(row["attractor_colour"].values)}
        for name in ("points", "multipliers"):
            if "attractor_" + name not in row.coords:
                continue
            numbers = row["attractor_" + name].values
            is_there = ~np.isnan(numbers) if numbers.ndim == 1 else ~np.isnan(numbers).all(axis=1)
            result[name] = numbers[is_there]
        return result
