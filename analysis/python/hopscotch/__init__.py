"""Read Hopscotch maps in Python: ``hopscotch.open("map.h5")`` gives an ``xarray.Dataset``.

The dataset has the map's axes as coordinates, its layers as variables and its attractors as variables
along the dimension ``attractor``. The accessor ``.hop`` knows names and colours and draws pictures:

>>> import hopscotch
>>> basins = hopscotch.open("map.h5")
>>> basins.hop.attractors()          # one dictionary per attractor
>>> basins.hop.plot()                # the labels, with matplotlib
>>> basins.hop.plot("time")

Needs numpy and xarray with h5netcdf or netCDF4, and matplotlib for pictures; no compiled part.
"""

from .accessor import HopAccessor
from .reading import open  # noqa: A004  (the word users type)

__all__ = ["open", "HopAccessor"]
