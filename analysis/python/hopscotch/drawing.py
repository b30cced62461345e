"""Pictures with matplotlib, in the colours of ``hopscotch render``."""

import numpy as np

NOT_COMPUTED = "#ececec"


def draw(dataset, layer, names, colours, ax, cells):
    """Draws a layer along its first (to the right) and second axis (upward)."""
    import matplotlib.pyplot as plt

    is_diagram = layer.dims[1:] == ("orbit", "sample") and not names and not cells
    sweep_axes = dataset.attrs.get("sweep_axes", "").split()
    layer, remarks = (layer, []) if is_diagram else _slice(layer, cells, sweep_axes)
    ax = ax if ax is not None else plt.subplots(layout="constrained")[1]
    if is_diagram:
        _diagram(ax, layer)
    elif layer.ndim == 1 and not names:
        _dots(ax, layer)
    elif names:
        _names(ax, layer, names, colours)
    else:
        _numbers(ax, layer)
    _describe(ax, dataset, layer, remarks)
    return ax


def _slice(layer, cells, sweep_axes):
    """One or two axes of a layer: of a sweep's index those of one map, of its table the sweep's."""
    unknown = set(cells) - set(layer.dims)
    if unknown:
        raise KeyError(f"{sorted(unknown)} is no axis of this map: {list(layer.dims)}")
    of_maps = [name for name in layer.dims if name not in (*sweep_axes, "attractor", "ending")]
    free = (of_maps or layer.dims)[:2]
    fixed = {name: cells.get(name, 0) for name in layer.dims if name not in free}
    fixed.update(cells)
    remarks = [f"{name} = {float(layer[name][cell]):.4g}" for name, cell in fixed.items()]
    return layer.isel(fixed), remarks


def _edges(layer, name):
    """Edges of the cells along an axis, half a cell beyond the samples (in log where it is log)."""
    values = np.asarray(layer[name].values, dtype=float)
    is_log = layer[name].attrs.get("scale") == "log"
    values = np.log(values) if is_log else values
    if values.size == 1:
        edges = np.array([values[0] - 0.5, values[0] + 0.5])
    else:
        middle = 0.5 * (values[1:] + values[:-1])
        edges = np.concatenate(([2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]))
    return np.exp(edges) if is_log else edges


def _mesh(ax, layer, numbers, **style):
    if layer.ndim == 1:
        ax.set_yticks([])
        return ax.pcolormesh(_edges(layer, layer.dims[0]), [0, 1], numbers[np.newaxis, :], **style)
    return ax.pcolormesh(_edges(layer, layer.dims[0]), _edges(layer, layer.dims[1]), numbers.T,
                         **style)


def _names(ax, layer, names, colours):
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    values = np.asarray(layer.values)
    present, counts = np.unique(values, return_counts=True)
    order = np.searchsorted(present, values)
    shown = [colours.get(v, NOT_COMPUTED) for v in present.tolist()]
    _mesh(ax, layer, order, cmap=ListedColormap(shown), vmin=-0.5, vmax=len(shown) - 0.5,
          rasterized=True)
    entries = sorted(zip(counts.tolist(), present.tolist(), shown), key=lambda entry: -entry[0])
    patches = [Patch(color=colour, label=f"{names.get(v, 'not computed')}  {n / values.size:.1%}")
               for n, v, colour in entries]
    ax.legend(handles=patches, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0,
              frameon=False, title=layer.name)


def _numbers(ax, layer):
    numbers = np.asarray(layer.values, dtype=float)
    fill = layer.attrs.get("_FillValue", np.nan)
    numbers = np.where(numbers == fill, np.nan, numbers)
    style = {"cmap": "viridis"}
    if np.nanmin(numbers) < 0.0 < np.nanmax(numbers):
        limit = np.nanmax(np.abs(numbers))
        style = {"cmap": "RdBu_r", "vmin": -limit, "vmax": limit}
    ax.set_facecolor("#b0b0b0" if "vmin" in style else NOT_COMPUTED)
    mesh = _mesh(ax, layer, numbers, rasterized=True, **style)
    ax.figure.colorbar(mesh, ax=ax, label=_title(layer))


def _dots(ax, layer):
    numbers = np.asarray(layer.values, dtype=float)
    numbers = np.where(numbers == layer.attrs.get("_FillValue", np.nan), np.nan, numbers)
    ax.plot(layer[layer.dims[0]].values, numbers, ".", markersize=2.0, color="#0072b2")
    ax.set_ylabel(_title(layer))


def _diagram(ax, layer):
    """Recorded states over the first axis: starts below, sweeps above them in colours of their own."""
    sweeps = {0: ("#0072b2", "rising"), 1: ("#e69f00", "falling")}
    across = np.repeat(layer[layer.dims[0]].values, layer.sizes["sample"])
    for orbit in sorted(layer["orbit"].values.tolist(), reverse=True):
        colour, name = sweeps.get(orbit, ("#b0b0b0", None))
        states = layer.sel(orbit=orbit).values.ravel()
        ax.plot(across, states, ",", color=colour, label=name, rasterized=True)
    ax.set_ylabel(_title(layer))


def _title(variable):
    name = str(variable.name).replace("_", " ")
    unit = variable.attrs.get("units", "1")
    return name if unit in ("", "1") else f"{name} ({unit})"


def _describe(ax, dataset, layer, remarks):
    ax.set_xlabel(_title(layer[layer.dims[0]]))
    setters = [ax.set_xscale]
    if layer.ndim == 2:
        ax.set_ylabel(_title(layer[layer.dims[1]]))
        setters.append(ax.set_yscale)
    for set_scale, name in zip(setters, layer.dims):
        if layer[name].attrs.get("scale") == "log":
            set_scale("log")
    title = dataset.attrs.get("title") or dataset.attrs.get("name") or ""
    ax.set_title(", ".join([title] + remarks) if title else ", ".join(remarks))
