classdef PuncturaInsertion < handle
  % PuncturaInsertion  A needle through the membranes of a scene: position in, force out.
  %
  %   insertion = PuncturaInsertion(fileread('scene.toml'));
  %   force = insertion.step([0; -1e-3; 0], [0; -1; 0]);    % one tick: m in, N out
  %   forces = insertion.run(positions, axis);              % 3 x n: n ticks
  %   force = insertion.peek(position, axis);               % what step would give; commit() makes it
  %   kept = insertion.state(); insertion.restore(kept);    % the same bits from there on
  %
  % The force is the model's, without limits. NaN in gives NaN out. Errors name every problem of the scene.

  properties (SetAccess = private, Hidden)
    number = [];
  end

  methods
    function self = PuncturaInsertion(scene_text)
      self.number = punctura_mex('new', scene_text);
    end
    function force = step(self, position, axis)
      force = punctura_mex('step', self.number, position, axis);
    end
    function force = peek(self, position, axis)
      force = punctura_mex('peek', self.number, position, axis);
    end
    function commit(self)
      punctura_mex('commit', self.number);
    end
    function forces = run(self, positions, axes)
      forces = punctura_mex('run', self.number, positions, axes);
    end
    function reset(self)
      punctura_mex('reset', self.number);
    end
    function bytes = state(self)
      bytes = punctura_mex('save', self.number);
    end
    function restore(self, bytes)
      punctura_mex('restore', self.number, bytes);
    end
    function delete(self)
      if ~isempty(self.number)
        punctura_mex('free', self.number);
        self.number = [];
      end
    end
  end
end
