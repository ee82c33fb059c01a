"""What run-gates itself saw pass, kept in out/gates/proofs.json: a summary in out/GATE may come from other hands, or from other sources."""
import datetime
import hashlib
import json

import gate_record


class Proofs:
    """`commit` is the whole name of HEAD at the start of the run; empty where the working tree differed from it: then nothing is kept."""

    def __init__(self, path, top):
        self.path, self.top, self.commit = path, top, gate_record.clean_commit(top)
        self.tools = hashlib.sha256(repr(sorted(gate_record.tools(top).items())).encode()).hexdigest()
        try:
            self.all = dict(json.loads(path.read_text(encoding='utf-8')))
        except (OSError, ValueError, TypeError):
            self.all = {}

    def of(self, row):
        """The proof of a gate that passed in its whole form, with these tools, at most a week ago, at this commit or at an earlier one since which nothing
        that it depends on changed; None: it has to run."""
        proof = self.all.get(row.name, {})
        if not self.commit or proof.get('tools') != self.tools or not self.stands(row, proof['commit']):
            return None
        age = datetime.datetime.now(datetime.timezone.utc) - datetime.datetime.fromisoformat(proof['date'])
        return proof if age <= gate_record.OLDEST else None

    def stands(self, row, commit):
        if commit == self.commit:
            return True
        try:
            return gate_record.Since(self.top, commit).stands(row)
        except ValueError:
            return False

    def keep(self, name, whole):
        """Of a gate that has just passed; a short form, or sources that changed meanwhile, take away what was known of it."""
        self.all.pop(name, None)
        if whole and self.commit and gate_record.clean_commit(self.top) == self.commit:
            now = datetime.datetime.now(datetime.timezone.utc).replace(microsecond=0)
            self.all[name] = {'commit': self.commit, 'tools': self.tools, 'date': now.isoformat()}
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self.path.write_text(json.dumps(self.all, indent=1), encoding='utf-8')
