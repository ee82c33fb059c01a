"""Folders of runs and campaigns."""
import unittest

import numpy as np

import flown
import lasso_mdat


class TablesTest(unittest.TestCase):
    def test_a_runs_frames_give_its_statistics(self):
        results = lasso_mdat.open_results(flown.run() / 'run')
        frames = results.frames[results.frames['lost'] == 0]
        self.assertEqual(results.summary['frames'], flown.FRAMES)
        self.assertAlmostEqual(np.sqrt(np.mean(frames['error_mm'] ** 2)), results.summary['noisy']['rms_mm'], places=4)
        self.assertEqual(set(frames['variant']), {'noisy'})
        self.assertEqual(len(results.packets['pose']), len(results.frames))

    def test_a_campaigns_cases_are_as_they_are_summed_up(self):
        flown.mdat('campaign', 'run', flown.MISSION, '--campaign', 'basin', '--set', 'campaign.basin.cases=4', '--no-report', '--out', 'basin')
        campaign = lasso_mdat.open_campaign(flown.folder() / 'basin')
        self.assertEqual(len(campaign.cases), 4)
        for criterion in campaign.summary['criteria']:
            values = campaign.cases[criterion['figure']]
            low, high = (value if value is not None else bound for value, bound in ((criterion['at_least'], -np.inf), (criterion['at_most'], np.inf)))
            self.assertEqual(np.sum((values >= low) & (values <= high)), criterion['within'], criterion['name'])

    def test_what_is_no_folder_of_mdat_is_told(self):
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'has no results.json'):
            lasso_mdat.open_results(flown.folder())
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'has no results.csv'):
            lasso_mdat.open_campaign(flown.run() / 'run')


if __name__ == '__main__':
    unittest.main()
