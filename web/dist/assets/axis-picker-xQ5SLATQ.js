import{b as e,x as t}from"./index-B5g3GHyC.js";function n(n,r,i,a){return n.length<2?e:t`
    <div class="row" role="radiogroup" aria-label="Axis">
      ${n.map(e=>t`
          <label class="line">
            <input type="radio" name=${i} .checked=${e===r} @change=${()=>a(e)} />${e}
          </label>
        `)}
    </div>
  `}export{n as t};