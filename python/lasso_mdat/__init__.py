"""What mdat writes, as NumPy arrays; and the registration that flies, to call (docs/python.md).

    run = lasso_mdat.open_recording('spin.mcap')      # run['/pose'], run.clouds('/scan'), run.packets()['pose']
    lasso_mdat.open_packets('telemetry.ccsds')        # ['pose']['p_sensor_target_m']
    lasso_mdat.open_results('out/run')                # .summary, .frames, .packets
    lasso_mdat.open_campaign('out/campaign-basin/campaign')  # .summary, .cases
    lasso_mdat.register(scan, mesh, prior), lasso_mdat.search(scan, mesh)

Pure Python and NumPy; zstd and the registration are reached by ctypes.
"""
from . import library
from .errors import LassoError
from .library import Target, mdat, read_scan, register, search
from .packets import Packets, open_packets
from .recording import Recording, open_recording
from .tables import open_campaign, open_results

__all__ = ['LassoError', 'Packets', 'Recording', 'Target', 'library', 'mdat', 'open_campaign', 'open_packets', 'open_recording', 'open_results', 'read_scan', 'register', 'search']
